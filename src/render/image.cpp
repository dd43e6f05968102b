#include "render/image.h"

#include <algorithm>
#include <cmath>

#include "io/result_colours.h"

namespace asdfvk {

Vec3d toLinear(const Rgb& colour) {
  const auto [red, green, blue] = linearColour({colour[0], colour[1], colour[2], 255});
  return {red, green, blue};
}

Rgb toRgb(const Vec3d& linear) {
  Rgb colour{};
  for (size_t channel = 0; channel < 3; ++channel) {
    const double l = std::clamp(linear[channel], 0.0, 1.0);
    const double s = l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
    colour[channel] = static_cast<uint8_t>(std::lround(s * 255));
  }
  return colour;
}

Rgb blend(const Rgb& under, const Rgb& over, double share) {
  if (share <= 0) return under;
  return toRgb(toLinear(under) * (1 - share) + toLinear(over) * share);
}

}  // namespace asdfvk
