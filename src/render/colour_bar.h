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

/// Ascending ticks within the range: 3 to 6 multiples of 1, 2, 2.5 or 5 times a power of ten, with the fewest digits
/// that distinguish them. If the range is a point or needs more than 9 digits, the ticks are its rounded ends.
[[nodiscard]] std::vector<Tick> ticksWithin(const ColourRange& range);

/// A colour bar in a column at the right side of a picture.
struct ColourBar {
  ColourRange range;
  std::string title;     ///< Above the bar. Scaled down if wider than a third of the picture.
  double capHeight = 0;  ///< Size of the text, in pixels.
};

/// Width of the column, in pixels.
[[nodiscard]] double columnWidth(const ColourBar& bar, double pictureWidth);

void drawColourBar(Image& image, const ColourBar& bar, const PixelArea& column);

}  // namespace asdfvk
