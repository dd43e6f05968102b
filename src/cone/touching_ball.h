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

/// A triangle with its unit normal.
struct PlaneTriangle {
  std::array<Vec3d, 3> corners;
  Vec3d normal;
};

/// The diameter of the ball that touches a face and a plane; NaN or infinite where there is none. offset: distance of
/// the plane from the point of the face, along its unit normal. It is linear in the offset on either side of 0.
[[nodiscard]] inline double planeDiameter(const Vec3d& axis, const Vec3d& normal, double offset) {
  return offset < 0 ? -2 * offset / (1 - dot(normal, axis)) : 2 * offset / (1 + dot(normal, axis));
}

/// The least ball at any point of the face, as far as a wall limits it: with a point p of the face, a point q of the
/// wall and v = q - p the diameter is |v|^2 / (v . m), m the inward normal -face.normal; the result has the least
/// diameter over all p and q. Points of the wall whose depth v . m is not above `minDepth` > 0 do not count. Where the
/// least diameter is above `limit`, the result is a larger one or infinite. The bits of the diameter do not depend on a
/// limit above it.
///
/// The balls of diameter T that touch the face fill the face, shifted by T/2 along m, extended by T/2: a convex set. If
/// a wall has one point in common with that set, a ball touches the wall at a corner, or, from a corner or an edge of
/// the face, at a point of an edge or of the interior. Each of these cases has a closed form; the least of all is
/// exact.
[[nodiscard]] TouchingBall leastTouchingBall(const PlaneTriangle& face, const PlaneTriangle& wall, double minDepth,
                                             double limit = std::numeric_limits<double>::infinity());

/// The ball at one point p of the face.
[[nodiscard]] TouchingBall leastTouchingBall(const Vec3d& point, const Vec3d& faceNormal, const PlaneTriangle& wall,
                                             double minDepth, double limit);

}  // namespace asdfvk
