#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/box3.h"

namespace asdfvk {

/// A box while the hierarchy is built: the upper bounds are held negated, so that growing it is eight minimums, which
/// compilers turn into two vector instructions. Lanes 3 and 7 belong to no axis.
struct alignas(16) SplitBox {
  std::array<float, 8> lanes;  ///< min.x min.y min.z - , -max.x -max.y -max.z -

  [[nodiscard]] static SplitBox empty() {
    SplitBox box;
    box.lanes.fill(std::numeric_limits<float>::infinity());
    return box;
  }
  void grow(const SplitBox& other) {
    for (size_t i = 0; i < 8; ++i) lanes[i] = other.lanes[i] < lanes[i] ? other.lanes[i] : lanes[i];
  }
  [[nodiscard]] float min(size_t axis) const { return lanes[axis]; }
  [[nodiscard]] float max(size_t axis) const { return -lanes[axis + 4]; }
  [[nodiscard]] float extent(size_t axis) const { return -lanes[axis + 4] - lanes[axis]; }
  /// Twice the centre, so that nothing is rounded more than once.
  [[nodiscard]] float doubledCentre(size_t axis) const { return lanes[axis] - lanes[axis + 4]; }
  [[nodiscard]] float halfArea() const { return extent(0) * extent(1) + extent(1) * extent(2) + extent(2) * extent(0); }
  [[nodiscard]] bool isEmpty() const { return !(min(0) <= max(0)); }
};

/// A triangle while the hierarchy is built; 48 bytes.
struct SplitTriangle {
  SplitBox box;
  uint32_t face = 0;
};

}  // namespace asdfvk
