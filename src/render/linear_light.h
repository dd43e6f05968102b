#pragma once

#include "core/vec3.h"
#include "render/image.h"

namespace asdfvk {

// Light is added in linear sRGB; 1 is white.

[[nodiscard]] Vec3d toLinear(const Rgb& colour);
/// Values outside [0, 1] are clamped.
[[nodiscard]] Rgb toRgb(const Vec3d& linear);
/// Blends `share` of `over` onto `under`.
[[nodiscard]] Rgb blend(const Rgb& under, const Rgb& over, double share);

}  // namespace asdfvk
