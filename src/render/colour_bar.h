#pragma once

#include <string>

#include "io/colour_map.h"
#include "render/camera.h"
#include "render/image.h"

namespace asdfvk {

/// The colour bar as a column of its own at the right side of a picture.
struct ColourBar {
  ColourRange range;
  std::string title;     ///< Above the bar; scaled down where it is wider than a third of the picture.
  double capHeight = 0;  ///< Of the text, in pixels.
};

/// In pixels.
[[nodiscard]] double columnWidth(const ColourBar& bar, double pictureWidth);

/// Draws it centred within `column`.
void drawColourBar(Image& image, const ColourBar& bar, const PixelArea& column);

}  // namespace asdfvk
