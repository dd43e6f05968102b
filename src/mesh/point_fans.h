#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// The corners of the faces by points: vertices at the same position are one point, so that a mesh whose faces have
/// vertices of their own is connected as well.
class PointFans {
 public:
  explicit PointFans(const TriangleMesh& mesh);

  /// The lowest vertex at the position of a vertex; stands for the point.
  [[nodiscard]] uint32_t pointOf(uint32_t vertex) const { return pointOf_[vertex]; }
  /// Corners 3 face + k at a point, ascending; empty for a vertex that stands for no point.
  [[nodiscard]] std::span<const uint32_t> cornersAt(uint32_t point) const {
    return std::span(corners_).subspan(first_[point], first_[point + 1] - first_[point]);
  }
  [[nodiscard]] uint32_t vertexCount() const { return static_cast<uint32_t>(pointOf_.size()); }

 private:
  std::vector<uint32_t> pointOf_;  // #V
  std::vector<uint32_t> first_;    // #V + 1
  std::vector<uint32_t> corners_;  // 3 #F
};

}  // namespace asdfvk
