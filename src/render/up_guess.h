#pragma once

#include <span>

#include "core/vec3.h"
#include "render/view.h"

namespace asdfvk {

/// Unit.
[[nodiscard]] Vec3d directionOf(Up up);

/// Stability of the points on a floor with that direction up: the area of the hull of the lowest points over the area
/// of the box seen from above. Negative if the mean of the points is outside of the hull (unstable); 0 if the hull has
/// no area.
[[nodiscard]] double standingShare(std::span<const Vec3d> points, Up up);

/// Y if the points are stable with y up, or in no direction. Otherwise another stable direction; z is tested first.
/// Static stability is the simplest criterion of Fu, Cohen-Or, Dror and Sheffer 2008 (Upright Orientation of Man-Made
/// Objects).
[[nodiscard]] Up guessUp(std::span<const Vec3d> points);

}  // namespace asdfvk
