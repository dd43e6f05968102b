#pragma once

#include <vector>

#include "trace/trace_scene.h"

namespace asdfvk {

/// Plane of a triangle, 32 bytes: normal * p = offset. The only data of a hit triangle that the length of a ray needs.
struct TrianglePlane {
  Vec3d normal;  ///< Unit.
  double offset = 0;
};
static_assert(sizeof(TrianglePlane) == 32);

/// One per primitive of the hierarchy.
[[nodiscard]] std::vector<TrianglePlane> trianglePlanes(const TraceScene& scene);

}  // namespace asdfvk
