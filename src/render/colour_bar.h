#pragma once

#include <string>
#include <vector>

#include "io/colour_map.h"
#include "render/camera.h"
#include "render/image.h"

namespace asdfvk {

struct Tick {
  double value = 0;
  std::string label;
};

/// Round numbers within the range, ascending and evenly spaced: 3 to 6 multiples of 1, 2, 2.5 or 5 times a power of
/// ten, with labels of the fewest digits that distinguish them. A range that is a point, or so narrow that its numbers
/// need more than 9 digits, has ticks at its ends, with rounded labels.
[[nodiscard]] std::vector<Tick> ticksWithin(const ColourRange& range);

/// The colour bar as a column of its own at the right side of a picture.
struct ColourBar {
  ColourRange range;
  std::string title;     ///< Above the bar; scaled down where it is wider than a third of the picture.
  double capHeight = 0;  ///< Size of the text, in pixels.
};

/// Width of the column, in pixels.
[[nodiscard]] double columnWidth(const ColourBar& bar, double pictureWidth);

/// Draws the bar, centred within `column`.
void drawColourBar(Image& image, const ColourBar& bar, const PixelArea& column);

}  // namespace asdfvk
