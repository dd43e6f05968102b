#pragma once

#include "core/vec3.h"

namespace asdfvk {

/// The opposing walls of a face: the faces whose normals differ from its normal by at least an angle. The balls that
/// touch a face from inside end at them (touching_ball.h).
struct OpposingWalls {
  double cosine = 0;  ///< Greatest cosine between the normals; includes a slack for rounding.

  [[nodiscard]] bool contain(const Vec3d& normal, const Vec3d& wallNormal) const {
    return dot(normal, wallNormal) <= cosine;
  }
};

/// angleDegrees: between the normals, above 90 and at most 180. Throws Error{OptionOutOfRange}.
[[nodiscard]] OpposingWalls makeOpposingWalls(double angleDegrees);

}  // namespace asdfvk
