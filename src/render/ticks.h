#pragma once

#include <string>
#include <vector>

#include "io/colour_map.h"

namespace asdfvk {

struct Tick {
  double value = 0;
  std::string label;
};

/// Round numbers within the range, ascending and evenly spaced: 3 to 6 multiples of 1, 2, 2.5 or 5 times a power of
/// ten, with labels of the fewest digits that distinguish them. For a range that is a point, or so narrow that its
/// numbers need more than 9 digits: its ends, rounded in the label.
[[nodiscard]] std::vector<Tick> ticksWithin(const ColourRange& range);

}  // namespace asdfvk
