#pragma once

#include <vector>

#include "trace/trace_scene.h"

namespace asdfvk {

/// Plane of a triangle, 32 bytes: normal * p = offset. The length of a ray needs no other data of the hit triangle.
struct TrianglePlane {
  Vec3d normal;  ///< Unit vector.
  double offset = 0;
};
static_assert(sizeof(TrianglePlane) == 32);

/// Returns one plane per primitive of the hierarchy.
[[nodiscard]] std::vector<TrianglePlane> trianglePlanes(const TraceScene& scene);

}  // namespace asdfvk
