#include "io/colour_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/percentiles.h"

namespace asdfvk {
namespace {

constexpr std::array<std::array<uint8_t, 3>, 9> kViridis{{{68, 1, 84},
                                                          {71, 45, 123},
                                                          {59, 82, 139},
                                                          {44, 114, 142},
                                                          {33, 145, 140},
                                                          {40, 174, 128},
                                                          {94, 201, 98},
                                                          {173, 220, 48},
                                                          {253, 231, 37}}};

}  // namespace

ColourRange percentileRange(std::span<const double> values) {
  constexpr std::array<double, 2> kShares{0.01, 0.99};
  const std::vector<double> ends = percentilesOf(values, kShares);
  return ends.empty() ? ColourRange{} : ColourRange{ends[0], ends[1]};
}

Rgba colourOf(double value, const ColourRange& range) {
  if (std::isnan(value)) return kNoValueColour;
  const double share =
      range.high > range.low ? (std::clamp(value, range.low, range.high) - range.low) / (range.high - range.low) : 0.5;
  const double position = share * double(kViridis.size() - 1);
  const size_t below = std::min(static_cast<size_t>(position), kViridis.size() - 2);
  const double fraction = position - double(below);
  Rgba colour{0, 0, 0, 255};
  for (size_t channel = 0; channel < 3; ++channel) {
    const double from = kViridis[below][channel], to = kViridis[below + 1][channel];
    colour[channel] = static_cast<uint8_t>(from + (to - from) * fraction + 0.5);
  }
  return colour;
}

}  // namespace asdfvk
