#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace asdfvk {

using Rgba = std::array<uint8_t, 4>;

inline constexpr Rgba kNoValueColour{128, 128, 128, 255};

/// Values at the ends of the colour map.
struct ColourRange {
  double low = 0, high = 0;
};

/// The 1st to the 99th percentile (nearest rank) of the finite values; {0, 0} without a finite value.
[[nodiscard]] ColourRange percentileRange(std::span<const double> values);

/// The perceptual colour map viridis (Smith and van der Walt 2015, CC0), interpolated linearly between nine of its
/// colours. Values beyond the range have the colour of the nearer end. If the ends are equal, all values have the
/// middle colour. NaN is grey.
[[nodiscard]] Rgba colourOf(double value, const ColourRange& range);

}  // namespace asdfvk
