#include "render/drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "render/linear_light.h"
#include "render/stroke_font.h"

namespace asdfvk {
namespace {

constexpr double kStrokeShare = 0.13;  ///< Of the height of capitals.

double squared(double x) { return x * x; }

double distanceToSegment(const FontPoint& p, const FontPoint& a, const FontPoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, lengthSquared = dx * dx + dy * dy;
  const double along = lengthSquared > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / lengthSquared : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::sqrt(squared(p.x - a.x - t * dx) + squared(p.y - a.y - t * dy));
}

double distanceToGlyph(const FontPoint& p, const Glyph& glyph, double dotExtra) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& stroke : glyph.strokes) {
    if (stroke.size() == 1) nearest = std::min(nearest, distanceToSegment(p, stroke[0], stroke[0]) - dotExtra);
    for (size_t i = 0; i + 1 < stroke.size(); ++i)
      nearest = std::min(nearest, distanceToSegment(p, stroke[i], stroke[i + 1]));
  }
  return nearest;
}

void drawGlyph(Image& image, const Glyph& glyph, double left, double baseline, double pixelsPerUnit,
               const Rgb& colour) {
  constexpr double kAscent = 17, kDescent = 6, kSide = 3;  // In font units: bounds of all glyphs.
  const double halfWidth = std::max(0.5, kStrokeShare * kCapHeight * pixelsPerUnit / 2);
  const double dotExtra = 0.35 * kStrokeShare * kCapHeight;
  const int beginX = std::max(0, static_cast<int>(std::floor(left - kSide * pixelsPerUnit)));
  const int endX = std::min(image.width(), static_cast<int>(std::ceil(left + (glyph.width + kSide) * pixelsPerUnit)));
  const int beginY = std::max(0, static_cast<int>(std::floor(baseline - kAscent * pixelsPerUnit)));
  const int endY = std::min(image.height(), static_cast<int>(std::ceil(baseline + kDescent * pixelsPerUnit)));
  for (int y = beginY; y < endY; ++y)
    for (int x = beginX; x < endX; ++x) {
      const FontPoint p{(x + 0.5 - left) / pixelsPerUnit, (baseline - y - 0.5) / pixelsPerUnit};
      const double distance = distanceToGlyph(p, glyph, dotExtra) * pixelsPerUnit;
      image.at(x, y) = blend(image.at(x, y), colour, std::clamp(halfWidth - distance + 0.5, 0.0, 1.0));
    }
}

/// Share of the pixel [i, i+1] inside [low, high].
double coverage(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, double(i)), 0.0, 1.0);
}

}  // namespace

double textWidth(std::string_view text, double capHeight) {
  if (text.empty()) return 0;
  double units = 0;
  for (const char character : text) units += advanceOf(character);
  const double lastGap = advanceOf(text.back()) - glyphOf(text.back()).width;
  return (units - lastGap) * capHeight / kCapHeight;
}

void drawText(Image& image, std::string_view text, double left, double baseline, double capHeight, const Rgb& colour) {
  const double pixelsPerUnit = capHeight / kCapHeight;
  for (const char character : text) {
    drawGlyph(image, glyphOf(character), left, baseline, pixelsPerUnit, colour);
    left += advanceOf(character) * pixelsPerUnit;
  }
}

double fittingCapHeight(std::string_view text, double capHeight, double width) {
  const double needed = textWidth(text, capHeight);
  return needed > width ? capHeight * width / needed : capHeight;
}

void fillRectangle(Image& image, double left, double top, double width, double height, const Rgb& colour) {
  const int endX = std::min(image.width(), static_cast<int>(std::ceil(left + width)));
  const int endY = std::min(image.height(), static_cast<int>(std::ceil(top + height)));
  for (int y = std::max(0, static_cast<int>(std::floor(top))); y < endY; ++y)
    for (int x = std::max(0, static_cast<int>(std::floor(left))); x < endX; ++x)
      image.at(x, y) = blend(image.at(x, y), colour, coverage(x, left, left + width) * coverage(y, top, top + height));
}

}  // namespace asdfvk
