#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "bvh/bvh.h"
#include "core/simd.h"

namespace asdfvk {

/// A box during the build. Upper bounds are stored negated, so that enlarging the box takes minimums only.
struct SplitBox {
  Float4 lower, negatedUpper;

  [[nodiscard]] ASDFVK_ALWAYS_INLINE static SplitBox empty() {
    const Float4 nothing = broadcast<Float4>(std::numeric_limits<float>::infinity());
    return {nothing, nothing};
  }
  ASDFVK_ALWAYS_INLINE void grow(const SplitBox& other) {
    lower = min(other.lower, lower);
    negatedUpper = min(other.negatedUpper, negatedUpper);
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Float4 extents() const { return -(negatedUpper + lower); }
  /// Twice the centre, with a single rounding. Lane 3 is 0, although lane 3 of `lower` may hold a face (SplitTriangle).
  /// The bits of a face are usually a denormal number, and processors multiply denormal numbers slowly.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Float4 doubledCentre() const {
    return select(IntsOf<Float4>{-1, -1, -1, 0}, lower) - negatedUpper;
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE float doubledCentre(size_t axis) const { return lower[axis] - negatedUpper[axis]; }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE float halfArea() const {
    const Float4 e = extents();
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
  [[nodiscard]] BvhNode toNode(uint32_t first, uint32_t triangleCount) const {
    return {
        {lower[0], lower[1], lower[2]}, first, {-negatedUpper[0], -negatedUpper[1], -negatedUpper[2]}, triangleCount};
  }
};

/// A triangle during the build, 32 bytes: its box, with its face in the unused lane of the lower corner.
struct alignas(32) SplitTriangle {
  SplitBox box;

  SplitTriangle() = default;
  SplitTriangle(const SplitBox& b, uint32_t face) : box(b) { box.lower[3] = std::bit_cast<float>(face); }
  float* numbers() { return reinterpret_cast<float*>(this); }
  [[nodiscard]] const float* numbers() const { return reinterpret_cast<const float*>(this); }
  [[nodiscard]] uint32_t face() const { return std::bit_cast<uint32_t>(float{box.lower[3]}); }
};
static_assert(sizeof(SplitTriangle) == 32);

/// Splits by the binned surface-area heuristic (Wald 2007), for many triangles by a sample. Reorders `triangles` and
/// returns the number of triangles on the left, at least one and less than all. If all centres of the sample coincide,
/// returns 0 and does not reorder. The result is the same for every instruction set. binCount: per axis, 2 to 32.
/// Precondition: the boxes are in normalised coordinates.
[[nodiscard]] size_t splitBySah(std::span<SplitTriangle> triangles, uint32_t binCount,
                                InstructionSet instructionSet = widestInstructionSet());

/// Splits at the median of the centres along their widest axis; if all centres coincide, into halves in the given
/// order. Precondition: at least two triangles.
[[nodiscard]] size_t splitAtMedian(std::span<SplitTriangle> triangles);

}  // namespace asdfvk
