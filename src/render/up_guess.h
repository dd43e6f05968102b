#pragma once

#include <span>

#include "core/vec3.h"
#include "render/view.h"

namespace asdfvk {

/// Unit.
[[nodiscard]] Vec3d directionOf(Up up);

/// How well the points stand on a floor with that direction up: the area between the lowest of them over the area of
/// the box from above, negative where the mean of the points is not over it and they would fall; 0 where what is
/// lowest has no area.
[[nodiscard]] double standingShare(std::span<const Vec3d> points, Up up);

/// Y, unless the points stand badly that way and well in another one, z before the rest: static stability, the simplest
/// sign of uprightness in Fu, Cohen-Or, Dror and Sheffer 2008 (Upright Orientation of Man-Made Objects).
[[nodiscard]] Up guessUp(std::span<const Vec3d> points);

}  // namespace asdfvk
