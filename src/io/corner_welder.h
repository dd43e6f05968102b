#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace asdfvk {

/// Gives equal points one index, in order of first appearance. Equal means the same three numbers, where -0 is 0; a
/// point with a NaN equals none, not even itself.
class CornerWelder {
 public:
  /// `expectedPointCount` (distinct ones) only saves time.
  explicit CornerWelder(uint64_t expectedPointCount);

  [[nodiscard]] uint32_t indexOf(Vec3d point);
  [[nodiscard]] std::vector<Vec3d>& points() { return points_; }

 private:
  void resizeTable(uint64_t slotCount);
  [[nodiscard]] uint64_t slotOf(const Vec3d& point) const;

  std::vector<Vec3d> points_;
  std::vector<uint32_t> table_;  ///< Open addressing with linear probing; at most two thirds full.
};

}  // namespace asdfvk
