#pragma once

#include "core/vec3.h"

namespace asdfvk {

/// Thickness of a face: the diameter of the largest ball that touches the face at its barycentre c from inside and
/// contains no point of an opposing wall. For a point p of a wall, v = p - c and the inward unit normal m, the ball
/// through p that touches the face has the diameter |v|^2 / (v . m); the thickness is the minimum over all opposing
/// walls. The opposing walls of a face are the faces whose normals differ from its normal by at least an angle.
struct OpposingWalls {
  double cosine = 0;  ///< Greatest cosine between the normals; includes kOpposingWallSlack of shared/cone_rules.h.

  [[nodiscard]] bool contain(const Vec3d& normal, const Vec3d& wallNormal) const {
    return dot(normal, wallNormal) <= cosine;
  }
};

/// angleDegrees: between the normals, above 90 and at most 180. Throws Error{OptionOutOfRange}.
[[nodiscard]] OpposingWalls makeOpposingWalls(double angleDegrees);

/// The diameter of the ball that touches a plane, as leastDiameter() of the whole plane; NaN or infinite where there is
/// none. offset: of the plane along its unit normal, from the barycentre of the face.
[[nodiscard]] inline double planeDiameter(const Vec3d& axis, const Vec3d& normal, double offset) {
  return offset < 0 ? -2 * offset / (1 - dot(normal, axis)) : 2 * offset / (1 + dot(normal, axis));
}

/// The corners of a wall relative to the barycentre of the face, and the unit normal of the wall.
struct WallTriangle {
  Vec3d a, b, c, normal;
};

/// The least diameter |v|^2 / (v . axis) over the points v of the triangle with v . axis > 0; 0 where the triangle
/// contains the origin; infinity where there is no such point or where the least diameter is not below `limit`. axis:
/// unit. In closed form: the ball that touches the plane of the triangle, or else those that touch its edges.
[[nodiscard]] double leastDiameter(const Vec3d& axis, const WallTriangle& wall, double limit);

}  // namespace asdfvk
