#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "render/image.h"

namespace asdfvk {

/// A point in font units: x from the left side of the glyph, y up from the baseline. Capitals are kCapHeight high.
struct FontPoint {
  double x = 0, y = 0;
};
inline constexpr double kCapHeight = 14;

/// A glyph as centre lines of strokes. A stroke is a chain of points; a single point is a dot.
struct Glyph {
  double width = 0;
  std::vector<std::vector<FontPoint>> strokes;
};

/// The glyph of a printable ASCII character; for any other byte, the question mark.
[[nodiscard]] const Glyph& glyphOf(char character);

/// Distance from the left side of a glyph to the left side of the next glyph.
[[nodiscard]] double advanceOf(char character);

// Antialiased drawing. Coordinates are in pixels from the top left corner. Parts outside of the image are clipped.

/// Width of a text, in pixels. capHeight: height of capitals, in pixels.
[[nodiscard]] double textWidth(std::string_view text, double capHeight);

/// One line of text in the stroke font, with its left end and baseline at (left, baseline).
void drawText(Image& image, std::string_view text, double left, double baseline, double capHeight,
              const Rgb& colour = kInk);

/// The largest capital height up to `capHeight` at which the text is no wider than `width`.
[[nodiscard]] double fittingCapHeight(std::string_view text, double capHeight, double width);

/// Fills the rectangle; pixels at its border are blended by coverage.
void fillRectangle(Image& image, double left, double top, double width, double height, const Rgb& colour);

}  // namespace asdfvk
