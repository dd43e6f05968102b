#include "render/drawing.h"

#include <doctest/doctest.h>

#include "core/point2.h"

namespace asdfvk {
namespace {

bool isSame(const Glyph& a, const Glyph& b) {
  if (a.strokes.size() != b.strokes.size()) return false;
  for (size_t i = 0; i < a.strokes.size(); ++i) {
    if (a.strokes[i].size() != b.strokes[i].size()) return false;
    for (size_t k = 0; k < a.strokes[i].size(); ++k)
      if (a.strokes[i][k].x != b.strokes[i][k].x || a.strokes[i][k].y != b.strokes[i][k].y) return false;
  }
  return true;
}

TEST_CASE("every printable character has a glyph of its own within its box") {
  for (char c = '!'; c <= '~'; ++c) {
    const Glyph& glyph = glyphOf(c);
    CAPTURE(c);
    CHECK_FALSE(glyph.strokes.empty());
    for (const auto& stroke : glyph.strokes) {
      CHECK_FALSE(stroke.empty());
      for (const Point2& point : stroke) {
        CHECK_GE(point.x, -0.6);
        CHECK_LE(point.x, glyph.width + 0.6);
        CHECK_GE(point.y, -4.9);
        CHECK_LE(point.y, 16.1);
      }
    }
    for (char other = '!'; other < c; ++other) CHECK_FALSE_MESSAGE(isSame(glyph, glyphOf(other)), other);
  }
}

TEST_CASE("capitals and digits have the documented height") {
  for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")) {
    double top = 0;
    for (const auto& stroke : glyphOf(c).strokes)
      for (const Point2& point : stroke) top = std::max(top, point.y);
    CAPTURE(c);
    CHECK_EQ(top, doctest::Approx(kCapHeight).epsilon(0.02));
  }
}

TEST_CASE("digits are equally wide but for the four, so that labels line up") {
  for (const char c : std::string_view("0123456789")) CHECK_EQ(glyphOf(c).width, doctest::Approx(9).epsilon(0.05));
}

TEST_CASE("a space is blank and other bytes are question marks") {
  CHECK(glyphOf(' ').strokes.empty());
  CHECK_GT(advanceOf(' '), 0);
  for (const char c : {'\n', '\x7f', '\xc3', '\0'}) CHECK(&glyphOf(c) == &glyphOf('?'));
}

}  // namespace
}  // namespace asdfvk
