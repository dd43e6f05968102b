#pragma once

#include <cmath>
#include <limits>

#include "cone/cone.h"
#include "core/vec3.h"

namespace asdfvk {

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// A ray as the frame in which triangles are tested: origin at 0, direction along z.
struct RayFrame {
  Vec3d origin;
  ConeFrame frame;  ///< frame.axis is the ray's unit direction.

  RayFrame(const Vec3d& rayOrigin, const Vec3d& direction) : origin(rayOrigin), frame(coneFrame(direction)) {}

  /// Depends on the vertex and the ray alone, so that triangles which share a vertex agree where it lies.
  [[nodiscard]] Vec3d toRay(const Vec3d& p) const {
    const Vec3d d = p - origin;
    return {dot(d, frame.tangent), dot(d, frame.bitangent), dot(d, frame.axis)};
  }
};

/// Distance along the ray to the triangle, of either facing, or kNoHit. Watertight, after Woop, Benthin and Wald 2013,
/// with a rotation instead of their shear. Signs cannot be wrong but only become zero, as rounding is monotone
/// (x * y >= z * w holds after rounding, too), and zero counts as inside: a ray between two triangles hits one at
/// least.
[[nodiscard]] inline double rayTriangleDistance(const RayFrame& ray, const Vec3d& v0, const Vec3d& v1,
                                                const Vec3d& v2) {
  const Vec3d a = ray.toRay(v0), b = ray.toRay(v1), c = ray.toRay(v2);
  const double u = c.x * b.y - c.y * b.x;
  const double v = a.x * c.y - a.y * c.x;
  const double w = b.x * a.y - b.y * a.x;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return kNoHit;
  const double det = u + v + w;
  if (det == 0) return kNoHit;
  const double t = (u * a.z + v * b.z + w * c.z) / det;
  return t >= 0 ? t : kNoHit;
}

}  // namespace asdfvk
