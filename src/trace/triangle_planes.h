#pragma once

#include <vector>

#include "trace/trace_scene.h"

namespace asdfvk {

/// Plane of a triangle: normal * p = offset. 32 bytes. The length of a ray needs no other data of the triangle that it
/// hits.
struct TrianglePlane {
  Vec3d normal;  ///< Unit.
  double offset = 0;
};
static_assert(sizeof(TrianglePlane) == 32);

/// One per primitive of the hierarchy.
[[nodiscard]] std::vector<TrianglePlane> trianglePlanes(const TraceScene& scene);

}  // namespace asdfvk
