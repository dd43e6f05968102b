#pragma once

#include "core/unset_vector.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Plane of a triangle, 32 bytes: normal * p = offset. The length of a ray needs no other data of the hit triangle.
/// A plane lies in one cache line.
struct alignas(32) TrianglePlane {
  Vec3d normal;  ///< Unit vector.
  double offset = 0;
};
static_assert(sizeof(TrianglePlane) == 32);

/// Returns one plane per primitive of the hierarchy.
[[nodiscard]] UnsetVector<TrianglePlane> trianglePlanes(const TraceScene& scene);

}  // namespace asdfvk
