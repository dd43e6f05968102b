#pragma once

#include "core/vec3.h"
#include "render/image.h"

namespace asdfvk {

// Light is added up in linear sRGB; 1 is white.

[[nodiscard]] Vec3d toLinear(const Rgb& colour);
/// What lies outside [0, 1] becomes the nearer end.
[[nodiscard]] Rgb toRgb(const Vec3d& linear);
/// `share` of `over` laid on `under`.
[[nodiscard]] Rgb blend(const Rgb& under, const Rgb& over, double share);

}  // namespace asdfvk
