#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace asdfvk {

using Rgba = std::array<uint8_t, 4>;

/// The colour of a face without a value.
inline constexpr Rgba kNoValueColour{128, 128, 128, 255};

/// What the ends of the colour map stand for.
struct ColourRange {
  double low = 0, high = 0;
};

/// The 1st to the 99th percentile (nearest rank) of the finite values; {0, 0} where there is none.
[[nodiscard]] ColourRange percentileRange(std::span<const double> values);

/// The perceptual map viridis (Smith and van der Walt 2015, CC0) through nine of its colours, evenly spaced and joined
/// linearly. Values beyond the range have the colour of its end, all have the middle one where the range is a point,
/// NaN is grey.
[[nodiscard]] Rgba colourOf(double value, const ColourRange& range);

}  // namespace asdfvk
