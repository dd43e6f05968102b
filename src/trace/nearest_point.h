#pragma once

#include <cstdint>
#include <limits>

#include "core/function_ref.h"
#include "shared/cone_hit.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// The point of the surface nearest to a query point, in normalised coordinates.
struct SurfacePoint {
  double distance = std::numeric_limits<double>::infinity();
  Vec3d point;
  uint32_t face = kNoFace;
  double side = 0;  ///< Cosine of the angle between the normal and the direction to the query point; above 0 outside.
};

/// Precondition: a != b.
[[nodiscard]] Vec3d nearestOnSegment(const Vec3d& a, const Vec3d& b, const Vec3d& p);
[[nodiscard]] Vec3d nearestPoint(const PlaneTriangle& triangle, const Vec3d& p);

/// The point of the surface nearest to p. faceOf(primitive face): the face that replaces the primitive face, or kNoFace
/// to ignore the primitive. The search ends at the first point less than `enough` away. If the nearest point is on an
/// edge or a vertex, the result has the face with the greatest abs(side). If several faces have this greatest number,
/// the first of them in the hierarchy is taken. atMost: a distance of some point of the surface, which shortens the
/// search and does not change its result.
[[nodiscard]] SurfacePoint nearestSurfacePoint(const TraceScene& scene, const Vec3d& p, double enough,
                                               FunctionRef<uint32_t(uint32_t)> faceOf,
                                               double atMost = std::numeric_limits<double>::infinity());

}  // namespace asdfvk
