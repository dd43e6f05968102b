#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace asdfvk {

/// Assigns one index to equal points. Indices ascend in the order of first appearance. -0 equals 0, and a point with a
/// NaN equals no point. Used for formats without indices, and for formats with several indices per point.
class CornerWelder {
 public:
  /// expectedPointCount: estimated number of distinct points, for the initial capacity.
  explicit CornerWelder(uint64_t expectedPointCount);

  /// Throws Error{MeshTooLarge} for more than kMaxIndexCount points.
  [[nodiscard]] uint32_t indexOf(Vec3d point);
  [[nodiscard]] std::vector<Vec3d>& points() { return points_; }

 private:
  void resizeTable(uint64_t slotCount);
  [[nodiscard]] uint64_t slotOf(const Vec3d& point) const;

  std::vector<Vec3d> points_;
  std::vector<uint32_t> table_;  ///< Open addressing with linear probing; at most two thirds full.
};

}  // namespace asdfvk
