#pragma once

#include <numbers>

#include "asdf_vk/options.h"
#include "core/check.h"
#include "core/elementary.h"
#include "core/vec3.h"

namespace asdfvk {

// Added to the cosine of the angle between opposing walls. Because of this slack, walls at exactly this angle are
// opposing despite rounding, such as the walls of a hexagonal prism at 120 degrees. The slack is 0.07 degrees at 120
// and 2.6 at 180 degrees.
inline constexpr double kOpposingWallSlack = 1e-3;

/// The opposing walls of a face: the faces whose normals differ from its normal by at least an angle. Opposing walls
/// limit the balls that touch the face from inside (touching_ball.h).
struct OpposingWalls {
  double cosine = 0;  ///< Greatest cosine between the normals; includes a slack for rounding.

  [[nodiscard]] bool contain(const Vec3d& normal, const Vec3d& wallNormal) const {
    return dot(normal, wallNormal) <= cosine;
  }
};

/// Precondition: the angle is in its range.
[[nodiscard]] inline OpposingWalls makeOpposingWalls(const ThicknessOptions& options) {
  const double angleDegrees = options.wallAngleDegrees;
  ASDFVK_CHECK(angleDegrees > 90 && angleDegrees <= 180);
  return {cosine(angleDegrees * std::numbers::pi / 180) + kOpposingWallSlack};
}

}  // namespace asdfvk
