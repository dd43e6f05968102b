#pragma once

#include <array>
#include <limits>

#include "core/vec3.h"

namespace asdfvk {

/// A ball that touches a face from inside at `onFace` and has `onWall`, a point of an opposing wall, on its surface.
struct TouchingBall {
  double diameter = std::numeric_limits<double>::infinity();
  Vec3d onFace, onWall;
};

struct PlaneTriangle {
  std::array<Vec3d, 3> corners;
  Vec3d normal;
};

/// The diameter of the ball that touches a face at a point and touches a plane; NaN or infinite if there is no such
/// ball. axis: inward unit normal of the face. normal: unit normal of the plane. offset: signed distance from the point
/// to the plane along `normal`. The diameter is linear in the offset on either side of 0.
[[nodiscard]] inline double planeDiameter(const Vec3d& axis, const Vec3d& normal, double offset) {
  return offset < 0 ? -2 * offset / (1 - dot(normal, axis)) : 2 * offset / (1 + dot(normal, axis));
}

/// The least ball that touches the face at any of its points and has a point of the wall on its surface. The diameter
/// is |v|^2 / dot(v, m), where v = q - p for a point p of the face and a point q of the wall, and m = -face.normal. The
/// result has the least diameter over all p and q. Points of the wall with a depth dot(v, m) of at most `minDepth`,
/// which is above 0, are ignored. If the least diameter is above `limit`, the diameter of the result is any number
/// above `limit`, or infinite. All limits of at least the least diameter give the same bits.
///
/// The balls of diameter T that touch the face fill a convex set: the face, shifted by T/2 along m and then extended by
/// T/2. For the least diameter, the wall has exactly one point in common with this set. This point is a corner of the
/// wall, or the ball touches the face at a corner or an edge. Each case has a closed form, so that the result is exact.
[[nodiscard]] TouchingBall leastTouchingBall(const PlaneTriangle& face, const PlaneTriangle& wall, double minDepth,
                                             double limit = std::numeric_limits<double>::infinity());

/// The least ball that touches the face at `point` and has a point of the wall on its surface.
[[nodiscard]] TouchingBall leastTouchingBall(const Vec3d& point, const Vec3d& faceNormal, const PlaneTriangle& wall,
                                             double minDepth, double limit);

}  // namespace asdfvk
