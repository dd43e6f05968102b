#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "core/point2.h"
#include "render/image.h"

namespace asdfvk {

[[nodiscard]] double distanceToSegment(const Point2& p, const Point2& a, const Point2& b);

inline constexpr double kCapHeight = 14;  ///< Height of capitals, in font units.

/// A glyph as centre lines of strokes, each a chain of points; a single point is a dot. In font units: x to the right
/// of the left side of the glyph, y up from the baseline.
struct Glyph {
  double width = 0;
  std::vector<std::vector<Point2>> strokes;
};

/// The glyph of a printable ASCII character; for any other byte, the question mark.
[[nodiscard]] const Glyph& glyphOf(char character);

/// Distance from the left side of a glyph to the left side of the next glyph.
[[nodiscard]] double advanceOf(char character);

// Antialiased drawing. Coordinates are in pixels from the top left corner. Parts outside of the image are clipped.

/// Blends `colour` where distance(pixel) is below half of `width`, within the rectangle from `low` to `high`.
template <typename Distance>
void stroke(Image& image, const Point2& low, const Point2& high, double width, const Rgb& colour,
            const Distance& distance) {
  const double reach = width / 2 + 1;
  const auto bound = [](double value, int limit) { return static_cast<int>(std::clamp(value, 0.0, double(limit))); };
  for (int y = bound(low.y - reach, image.height()); y < bound(high.y + reach + 1, image.height()); ++y)
    for (int x = bound(low.x - reach, image.width()); x < bound(high.x + reach + 1, image.width()); ++x) {
      const double share = std::clamp(width / 2 - distance(Point2{x + 0.5, y + 0.5}) + 0.5, 0.0, 1.0);
      image.at(x, y) = blend(image.at(x, y), colour, share);
    }
}

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
