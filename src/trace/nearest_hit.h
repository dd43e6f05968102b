#pragma once

#include <cstdint>
#include <limits>

#include "bvh/bvh.h"
#include "cone/cone.h"
#include "core/function_ref.h"
#include "core/vec3.h"
#include "shared/cone_hit.h"

namespace asdfvk {

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// The frame of a ray for tests of triangles: origin at 0, direction along z.
struct RayFrame {
  Vec3d origin;
  ConeFrame frame;  ///< frame.axis is the ray's unit direction.

  RayFrame(const Vec3d& rayOrigin, const Vec3d& direction) : origin(rayOrigin), frame(coneFrame(direction)) {}

  /// Coordinates of a vertex in the frame. The coordinates depend on the vertex and the ray only: they are the same for
  /// all triangles with this vertex.
  [[nodiscard]] Vec3d toRay(const Vec3d& p) const {
    const Vec3d d = p - origin;
    return {dot(d, frame.tangent), dot(d, frame.bitangent), dot(d, frame.axis)};
  }
};

struct TriangleHit {
  double distance = kNoHit;  ///< Distance along the ray.
  bool isOuterSide = false;  ///< Whether the ray hits the side from which the corners are counterclockwise.
};

/// The hit of a ray, on either side of the triangle. Watertight, after Woop, Benthin and Wald 2013, with a rotation
/// instead of their shear. Rounding is monotone: it can change a number to zero, but not invert its sign. Zero counts
/// as inside, so that a ray between two triangles hits at least one of them.
[[nodiscard]] inline TriangleHit hitTriangle(const RayFrame& ray, const Vec3d& v0, const Vec3d& v1, const Vec3d& v2) {
  const Vec3d a = ray.toRay(v0), b = ray.toRay(v1), c = ray.toRay(v2);
  const double u = c.x * b.y - c.y * b.x;
  const double v = a.x * c.y - a.y * c.x;
  const double w = b.x * a.y - b.y * a.x;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return {};
  const double det = u + v + w;
  if (det == 0) return {};
  const double t = (u * a.z + v * b.z + w * c.z) / det;
  return {t >= 0 ? t : kNoHit, det > 0};
}

struct RayHit {
  double distance = kNoHit;  ///< Distance along the ray, in normalised units.
  uint32_t face = kNoFace;   ///< kNoFace for a miss.
};

/// The nearest triangle that the ray hits, except `skippedFace` and triangles within contactDistance
/// (Cone::contactDistance). If several triangles are equally near, the one with the lowest face index is hit. Origin
/// and unit direction are in normalised coordinates. The origin is in the box of the root or near it.
[[nodiscard]] RayHit nearestHit(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction,
                                uint32_t skippedFace, double contactDistance = 0);

/// Like nearestHit(), but hits only faces for which counts(face) is true.
[[nodiscard]] RayHit nearestHitAmong(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin,
                                     const Vec3d& direction, FunctionRef<bool(uint32_t face)> counts);

/// Whether the ray hits a triangle at a distance from `begin` to `end`. Origin and direction as in nearestHit(), but
/// the distance of the origin from the centre of the normalised box may be up to 4.
[[nodiscard]] bool isHitBetween(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction,
                                double begin, double end);

}  // namespace asdfvk
