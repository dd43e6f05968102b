#include "render/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/point2.h"
#include "render/image.h"

namespace asdfvk {
namespace {

constexpr char kFirst = '!', kLast = '~';
constexpr double kGap = 3.6, kSpaceAdvance = 7;

/// A glyph as text: `m x y` begins a stroke, `l x y` adds a line. `a cx cy rx ry from to` adds a line to an elliptic
/// arc, and the arc between two angles in degrees (ascending: counter-clockwise). `n` begins a stroke at the next arc.
struct GlyphText {
  double width;
  const char* strokes;
};

constexpr std::array<GlyphText, kLast - kFirst + 1> kGlyphs{{
    /* ! */ {0, "m 0 14 l 0 4.5 m 0 0.3"},
    /* " */ {4, "m 0 14 l 0 9.5 m 4 14 l 4 9.5"},
    /* # */ {10, "m 2 0 l 4.5 14 m 6 0 l 8.5 14 m 0.5 9.5 l 10 9.5 m 0 4.5 l 9.5 4.5"},
    /* $ */ {9, "n a 4.5 10 3.9 3 30 270 a 4.5 3.8 4.2 3.2 90 -150 m 4.5 15.5 l 4.5 -1.5"},
    /* % */ {13, "n a 2.8 11 2.8 3 0 360 n a 10.2 3 2.8 3 0 360 m 11 14 l 2 0"},
    /* & */ {10.5, "m 10.5 0 l 2.4 9.2 a 4.5 11.2 2.7 2.8 220 -40 l 2.2 7 a 4 3.7 4 3.7 118 320 l 9.8 6.6"},
    /* ' */ {0, "m 0 14 l 0 9.5"},
    /* ( */ {3.4, "n a 6.4 5.6 6.4 10.4 118 242"},
    /* ) */ {3.4, "n a -3 5.6 6.4 10.4 62 -62"},
    /* * */ {6.6, "m 3.3 14 l 3.3 6.6 m 0.1 12.15 l 6.5 8.45 m 0.1 8.45 l 6.5 12.15"},
    /* + */ {9, "m 4.5 1.5 l 4.5 10.5 m 0 6 l 9 6"},
    /* , */ {1.2, "m 1.2 0.6 l 0.2 -2.8"},
    /* - */ {6, "m 0 5.6 l 6 5.6"},
    /* . */ {0, "m 0 0.3"},
    /* / */ {6.5, "m 0 -2 l 6.5 15.5"},
    /* 0 */ {9, "n a 4.5 7 4.5 7 0 360"},
    /* 1 */ {9, "m 1.6 11.2 l 5.4 14 l 5.4 0"},
    /* 2 */ {9, "n a 4.4 9.9 4.2 4.1 165 -32 l 0.2 0 l 9 0"},
    /* 3 */ {9, "n a 4.2 10.55 3.9 3.45 150 -90 a 4.2 3.55 4.6 3.55 90 -150"},
    /* 4 */ {9.4, "m 7 0 l 7 14 l 0 4 l 9.4 4"},
    /* 5 */ {9, "m 8.2 14 l 1.6 14 l 0.9 7.6 a 4.3 4.6 4.5 4.6 135 -150"},
    /* 6 */ {9, "n a 4.5 4.5 4.5 4.5 0 360 n a 8 4.5 8 9.5 180 100"},
    /* 7 */ {9, "m 0 14 l 9 14 l 3.2 0"},
    /* 8 */ {9, "n a 4.5 10.6 3.8 3.4 0 360 n a 4.5 3.6 4.5 3.6 0 360"},
    /* 9 */ {9, "n a 4.5 9.5 4.5 4.5 0 360 n a 1 9.5 8 9.5 0 -80"},
    /* : */ {0, "m 0 9 m 0 0.3"},
    /* ; */ {1.2, "m 1 9 m 1.2 0.6 l 0.2 -2.8"},
    /* < */ {8.5, "m 8.5 11 l 0 6 l 8.5 1"},
    /* = */ {9, "m 0 8.2 l 9 8.2 m 0 3.8 l 9 3.8"},
    /* > */ {8.5, "m 0 11 l 8.5 6 l 0 1"},
    /* ? */ {8, "n a 4 10.2 4 3.8 165 -45 l 4 5.8 l 4 4.3 m 4 0.3"},
    /* @ */ {15, "n a 7.3 5.8 3 3.2 0 360 m 10.3 9 l 10.3 5 a 12.6 5 2.3 2.2 180 360 a 7.5 6 7.4 7.6 0 305"},
    /* A */ {11, "m 0 0 l 5.5 14 l 11 0 m 1.9 4.8 l 9.1 4.8"},
    /* B */ {9.5, "m 0 7.3 l 5 7.3 m 0 0 l 0 14 l 5 14 a 5 10.65 3.6 3.35 90 -90 a 5.2 3.65 4.3 3.65 90 -90 l 0 0"},
    /* C */ {10.8, "n a 6.2 7 6.2 7 45 315"},
    /* D */ {10.8, "m 0 0 l 0 14 l 4.2 14 a 4.2 7 6.6 7 90 -90 l 0 0"},
    /* E */ {8.5, "m 8.5 14 l 0 14 l 0 0 l 8.5 0 m 0 7.3 l 7.3 7.3"},
    /* F */ {8.3, "m 8.3 14 l 0 14 l 0 0 m 0 7.1 l 7.1 7.1"},
    /* G */ {12, "n a 6.2 7 6.2 7 45 343 l 12.1 6.6 l 7.2 6.6"},
    /* H */ {10, "m 0 0 l 0 14 m 10 0 l 10 14 m 0 7.3 l 10 7.3"},
    /* I */ {0, "m 0 0 l 0 14"},
    /* J */ {6, "m 6 14 l 6 3.8 a 2.9 3.8 3.1 3.8 0 -160"},
    /* K */ {9.4, "m 0 0 l 0 14 m 9 14 l 0 5.2 m 3.3 8.4 l 9.4 0"},
    /* L */ {8, "m 0 14 l 0 0 l 8 0"},
    /* M */ {12, "m 0 0 l 0 14 l 6 2.2 l 12 14 l 12 0"},
    /* N */ {10, "m 0 0 l 0 14 l 10 0 l 10 14"},
    /* O */ {12.6, "n a 6.3 7 6.3 7 0 360"},
    /* P */ {9, "m 0 0 l 0 14 l 5.2 14 a 5.2 10.3 3.7 3.7 90 -90 l 0 6.6"},
    /* Q */ {12.8, "n a 6.3 7 6.3 7 0 360 m 8 3.6 l 12.6 -1.2"},
    /* R */ {9.3, "m 0 0 l 0 14 l 5.2 14 a 5.2 10.3 3.7 3.7 90 -90 l 0 6.6 m 5 6.6 l 9.3 0"},
    /* S */ {9, "n a 4.5 10.5 4 3.5 30 270 a 4.5 3.5 4.4 3.5 90 -150"},
    /* T */ {10, "m 0 14 l 10 14 m 5 14 l 5 0"},
    /* U */ {10, "m 0 14 l 0 5 a 5 5 5 5 180 360 l 10 14"},
    /* V */ {10.6, "m 0 14 l 5.3 0 l 10.6 14"},
    /* W */ {15, "m 0 14 l 3.8 0 l 7.5 13 l 11.2 0 l 15 14"},
    /* X */ {9.6, "m 0 0 l 9.6 14 m 0 14 l 9.6 0"},
    /* Y */ {10, "m 0 14 l 5 7 l 10 14 m 5 7 l 5 0"},
    /* Z */ {9.6, "m 0.2 14 l 9.4 14 l 0 0 l 9.6 0"},
    /* [ */ {3.2, "m 3.2 15.5 l 0 15.5 l 0 -3 l 3.2 -3"},
    /* \ */ {6.5, "m 0 15.5 l 6.5 -2"},
    /* ] */ {3.2, "m 0 15.5 l 3.2 15.5 l 3.2 -3 l 0 -3"},
    /* ^ */ {7, "m 0 9 l 3.5 14 l 7 9"},
    /* _ */ {9, "m 0 -2.2 l 9 -2.2"},
    /* ` */ {2.4, "m 0 14 l 2.4 11.6"},
    /* a */ {8.6, "n a 4.3 4.8 4.3 4.8 0 360 m 8.6 9.6 l 8.6 0"},
    /* b */ {8.6, "n a 4.3 4.8 4.3 4.8 0 360 m 0 14.6 l 0 0"},
    /* c */ {7.9, "n a 4.6 4.8 4.6 4.8 45 315"},
    /* d */ {8.6, "n a 4.3 4.8 4.3 4.8 0 360 m 8.6 14.6 l 8.6 0"},
    /* e */ {8.8, "m 0 5 l 8.8 5 a 4.4 4.8 4.4 4.8 0 315"},
    /* f */ {5, "m 1.8 0 l 1.8 11.8 a 4.6 11.8 2.8 2.9 180 80 m 0 9.4 l 4.8 9.4"},
    /* g */ {8.6, "n a 4.3 4.8 4.3 4.8 0 360 m 8.6 9.6 l 8.6 -0.2 a 4.5 -0.2 4.1 4.2 0 -150"},
    /* h */ {8, "m 0 14.6 l 0 0 n a 4 5.6 4 4 180 0 l 8 0"},
    /* i */ {0, "m 0 0 l 0 9.6 m 0 13.6"},
    /* j */ {2, "m 2 9.6 l 2 -1.6 a -0.2 -1.6 2.2 2.6 0 -95 m 2 13.6"},
    /* k */ {7.4, "m 0 14.6 l 0 0 m 7 9.6 l 0 3.4 m 2.5 5.7 l 7.4 0"},
    /* l */ {0, "m 0 0 l 0 14.6"},
    /* m */ {12.8, "m 0 0 l 0 9.6 n a 3.2 6.2 3.2 3.4 180 0 l 6.4 0 n a 9.6 6.2 3.2 3.4 180 0 l 12.8 0"},
    /* n */ {8, "m 0 0 l 0 9.6 n a 4 5.6 4 4 180 0 l 8 0"},
    /* o */ {9, "n a 4.5 4.8 4.5 4.8 0 360"},
    /* p */ {8.6, "n a 4.3 4.8 4.3 4.8 0 360 m 0 9.6 l 0 -4.4"},
    /* q */ {8.6, "n a 4.3 4.8 4.3 4.8 0 360 m 8.6 9.6 l 8.6 -4.4"},
    /* r */ {4.8, "m 0 0 l 0 9.6 n a 4 5.4 4 4.2 180 78"},
    /* s */ {7.2, "n a 3.6 7.2 3.1 2.4 30 270 a 3.6 2.4 3.5 2.4 90 -150"},
    /* t */ {5.2, "m 1.8 13 l 1.8 3 a 4.4 3 2.6 3 180 285 m 0 9.6 l 5 9.6"},
    /* u */ {8, "m 0 9.6 l 0 4 a 4 4 4 4 180 360 m 8 9.6 l 8 0"},
    /* v */ {8, "m 0 9.6 l 4 0 l 8 9.6"},
    /* w */ {12, "m 0 9.6 l 3 0 l 6 9 l 9 0 l 12 9.6"},
    /* x */ {7.4, "m 0 0 l 7.4 9.6 m 0 9.6 l 7.4 0"},
    /* y */ {8.2, "m 0 9.6 l 4.2 0 m 8.2 9.6 l 2.4 -4.4"},
    /* z */ {7.4, "m 0.2 9.6 l 7.2 9.6 l 0 0 l 7.4 0"},
    /* { */ {4, "m 4 15.5 l 2.2 14.5 l 2.2 8 l 0 6.2 l 2.2 4.4 l 2.2 -2 l 4 -3"},
    /* | */ {0, "m 0 15.5 l 0 -3"},
    /* } */ {4, "m 0 15.5 l 1.8 14.5 l 1.8 8 l 4 6.2 l 1.8 4.4 l 1.8 -2 l 0 -3"},
    /* ~ */ {9, "n a 2.4 5.6 2.4 1.8 170 30 l 6 4.9 a 6.8 6.4 2.4 1.8 215 350"},
}};

void appendArc(std::vector<Point2>& stroke, std::istream& in) {
  double centreX = 0, centreY = 0, radiusX = 0, radiusY = 0, from = 0, to = 0;
  in >> centreX >> centreY >> radiusX >> radiusY >> from >> to;
  const int steps = std::max(2, static_cast<int>(std::abs(to - from) / 12));
  for (int i = 0; i <= steps; ++i) {
    const double angle = (from + (to - from) * i / steps) * std::numbers::pi / 180;
    stroke.push_back({centreX + radiusX * std::cos(angle), centreY + radiusY * std::sin(angle)});
  }
}

Glyph parseGlyph(const GlyphText& text) {
  Glyph glyph{text.width, {}};
  std::istringstream in(text.strokes);
  for (char command = 0; in >> command;) {
    if (command == 'm' || command == 'n') glyph.strokes.emplace_back();
    if (command == 'a') {
      appendArc(glyph.strokes.back(), in);
    } else if (command != 'n') {
      Point2 point;
      in >> point.x >> point.y;
      glyph.strokes.back().push_back(point);
    }
  }
  return glyph;
}

constexpr double kStrokeShare = 0.13;  ///< Width of a stroke, divided by the height of capitals.

double distanceToGlyph(const Point2& p, const Glyph& glyph, double dotExtra) {
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
  const double width = std::max(1.0, kStrokeShare * kCapHeight * pixelsPerUnit);
  const double dotExtra = 0.35 * kStrokeShare * kCapHeight;
  stroke(image, {left - kSide * pixelsPerUnit, baseline - kAscent * pixelsPerUnit},
         {left + (glyph.width + kSide) * pixelsPerUnit, baseline + kDescent * pixelsPerUnit}, width, colour,
         [&](const Point2& p) {
           const Point2 inFont{(p.x - left) / pixelsPerUnit, (baseline - p.y) / pixelsPerUnit};
           return distanceToGlyph(inFont, glyph, dotExtra) * pixelsPerUnit;
         });
}

/// Share of the pixel [i, i+1] inside [low, high].
double coverage(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, double(i)), 0.0, 1.0);
}

}  // namespace

double distanceToSegment(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, lengthSquared = dx * dx + dy * dy;
  const double along = lengthSquared > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / lengthSquared : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

const Glyph& glyphOf(char character) {
  static const std::vector<Glyph> glyphs = [] {
    std::vector<Glyph> parsed;
    std::transform(kGlyphs.begin(), kGlyphs.end(), std::back_inserter(parsed), parseGlyph);
    return parsed;
  }();
  static const Glyph blank;
  if (character == ' ') return blank;
  if (character < kFirst || character > kLast) character = '?';
  return glyphs[static_cast<size_t>(character - kFirst)];
}

double advanceOf(char character) { return character == ' ' ? kSpaceAdvance : glyphOf(character).width + kGap; }

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
