#pragma once

#include <string_view>

#include "render/image.h"

namespace asdfvk {

// Antialiased drawing on a finished image. Coordinates are in pixels from its top left corner; parts outside of the
// image are clipped.

/// `capHeight` is that of capitals, in pixels.
[[nodiscard]] double textWidth(std::string_view text, double capHeight);

/// One line of text in the stroke font, with its left end and baseline at (left, baseline).
void drawText(Image& image, std::string_view text, double left, double baseline, double capHeight,
              const Rgb& colour = kInk);

/// The largest capital height up to `capHeight` at which the text is no wider than `width`.
[[nodiscard]] double fittingCapHeight(std::string_view text, double capHeight, double width);

/// Fills the rectangle; pixels at its border are blended by coverage.
void fillRectangle(Image& image, double left, double top, double width, double height, const Rgb& colour);

}  // namespace asdfvk
