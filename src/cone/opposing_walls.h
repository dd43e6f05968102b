#pragma once

#include "asdf_vk/options.h"
#include "core/vec3.h"

namespace asdfvk {

/// The opposing walls of a face: the faces whose normals differ from its normal by at least an angle. Opposing walls
/// limit the balls that touch the face from inside (touching_ball.h).
struct OpposingWalls {
  double cosine = 0;  ///< Greatest cosine between the normals; includes a slack for rounding.

  [[nodiscard]] bool contain(const Vec3d& normal, const Vec3d& wallNormal) const {
    return dot(normal, wallNormal) <= cosine;
  }
};

/// Precondition: the angle is in its range.
[[nodiscard]] OpposingWalls makeOpposingWalls(const ThicknessOptions& options);

}  // namespace asdfvk
