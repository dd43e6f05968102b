#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "bvh/bvh.h"
#include "core/simd.h"

namespace asdfvk {

/// A box while the hierarchy is built: the upper bounds are held negated, so that growing it is two minimums.
struct SplitBox {
  Float4 lower, negatedUpper;

  [[nodiscard]] static SplitBox empty() {
    const Float4 nothing = broadcast<Float4>(std::numeric_limits<float>::infinity());
    return {nothing, nothing};
  }
  void grow(const SplitBox& other) {
    lower = min(other.lower, lower);
    negatedUpper = min(other.negatedUpper, negatedUpper);
  }
  [[nodiscard]] Float4 extents() const { return -(negatedUpper + lower); }
  /// Twice the centre, so that nothing is rounded more than once.
  [[nodiscard]] Float4 doubledCentre() const { return lower - negatedUpper; }
  [[nodiscard]] float doubledCentre(size_t axis) const { return lower[axis] - negatedUpper[axis]; }
  [[nodiscard]] float halfArea() const {
    const Float4 e = extents();
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
  [[nodiscard]] BvhNode toNode(uint32_t first, uint32_t triangleCount) const {
    return {
        {lower[0], lower[1], lower[2]}, first, {-negatedUpper[0], -negatedUpper[1], -negatedUpper[2]}, triangleCount};
  }
};

/// A triangle while the hierarchy is built: its box, and in the lower corner's spare lane its face. 32 bytes.
struct SplitTriangle {
  SplitBox box;

  SplitTriangle() = default;
  SplitTriangle(const SplitBox& b, uint32_t face) : box(b) { box.lower[3] = std::bit_cast<float>(face); }
  [[nodiscard]] uint32_t face() const { return std::bit_cast<uint32_t>(float{box.lower[3]}); }
};
static_assert(sizeof(SplitTriangle) == 32);

}  // namespace asdfvk
