#pragma once

#include <cstdint>
#include <span>

#include "core/bucket_sort.h"
#include "core/unset_vector.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The corners of faces at each point. Vertices at the same position are one point. Therefore faces are also connected
/// if they share a position but no vertex.
class PointFans {
 public:
  explicit PointFans(const TriangleMesh& mesh);

  /// The lowest vertex at the position of the given vertex. Its index stands for the point.
  [[nodiscard]] uint32_t pointOf(uint32_t vertex) const { return pointOf_[vertex]; }
  /// Corners 3 face + k at a point, ascending; empty for a vertex that does not stand for a point.
  [[nodiscard]] std::span<const uint32_t> cornersAt(uint32_t point) const { return corners_[point]; }
  [[nodiscard]] uint32_t vertexCount() const { return static_cast<uint32_t>(pointOf_.size()); }

 private:
  UnsetVector<uint32_t> pointOf_;  // #V
  Buckets<uint32_t> corners_;      // 3 #F, by point.
};

}  // namespace asdfvk
