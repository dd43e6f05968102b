#include "render/image.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {

Vec3d toLinear(const Rgb& colour) {
  static const std::array<double, 256> kLinear = [] {
    std::array<double, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
      const double s = static_cast<double>(i) / 255;
      table[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return table;
  }();
  return {kLinear[colour[0]], kLinear[colour[1]], kLinear[colour[2]]};
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
