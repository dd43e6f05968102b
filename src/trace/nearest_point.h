#pragma once

#include <cstdint>
#include <limits>

#include "core/function_ref.h"
#include "shared/cone_hit.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A point of the surface that is nearest to some point, in normalised coordinates.
struct SurfacePoint {
  double distance = std::numeric_limits<double>::infinity();
  Vec3d point;
  uint32_t face = kNoFace;
  double side = 0;  ///< Cosine between the normal and the way from the surface; above 0 outside.
};

[[nodiscard]] Vec3d nearestPoint(const PlaneTriangle& triangle, const Vec3d& p);

/// Between a point and the box of a node; 0 inside.
[[nodiscard]] double squaredDistanceToBox(const BvhNode& box, const Vec3d& p);

/// faceOf(primitive face): the face that counts in its place, kNoFace for none. Ends at the first point less than
/// `enough` away. Where points coincide on an edge or a vertex, the face that the way from them meets most steeply has
/// the side; of equal ones the first in the hierarchy.
[[nodiscard]] SurfacePoint nearestSurfacePoint(const TraceScene& scene, const Vec3d& p, double enough,
                                               FunctionRef<uint32_t(uint32_t)> faceOf);

}  // namespace asdfvk
