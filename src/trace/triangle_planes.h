#pragma once

#include <vector>

#include "trace/trace_scene.h"

namespace asdfvk {

/// Plane of a triangle: normal * p = offset. 32 bytes; no other data of a hit triangle is needed.
struct TrianglePlane {
  Vec3d normal;  ///< Unit.
  double offset = 0;
};
static_assert(sizeof(TrianglePlane) == 32);

/// One per primitive of the hierarchy.
[[nodiscard]] std::vector<TrianglePlane> trianglePlanes(const TraceScene& scene);

}  // namespace asdfvk
