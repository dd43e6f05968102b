#include "render/drawing.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace asdfvk {
namespace {

/// The columns and rows that hold anything but white: [left, right) x [top, bottom).
struct Ink {
  int left = 1 << 20, right = 0, top = 1 << 20, bottom = 0;
  explicit Ink(const Image& image) {
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (image.at(x, y) != kWhite) {
          left = std::min(left, x), right = std::max(right, x + 1);
          top = std::min(top, y), bottom = std::max(bottom, y + 1);
        }
  }
};

TEST_CASE("text has the reported width and height, up to its stroke") {
  Image image(600, 100);
  drawText(image, "HANDLE", 50, 70, 40);
  const Ink ink(image);
  CHECK_LE(std::abs(ink.left - 50), 4);
  CHECK_LE(std::abs(ink.right - (50 + textWidth("HANDLE", 40))), 4);
  CHECK_LE(std::abs(ink.top - 30), 4);
  CHECK_LE(std::abs(ink.bottom - 70), 4);
  CHECK_EQ(textWidth("", 40), 0);
}

TEST_CASE("strokes are antialiased, and dark in their middle") {
  Image image(60, 60);
  drawText(image, "I", 30.3, 50, 40);
  CHECK(image.at(30, 30) == kInk);
  int between = 0;
  for (int x = 0; x < 60; ++x) between += image.at(x, 30) != kWhite && image.at(x, 30) != kInk;
  CHECK_GE(between, 1);
  CHECK_LE(between, 2);
}

TEST_CASE("drawing outside of the image is clipped") {
  Image image(20, 20);
  drawText(image, "cut off at both sides", -30, 15, 20);
  const Ink ink(image);
  CHECK_LT(ink.left, 5);
  CHECK_GT(ink.right, 10);
  Image other(20, 20);
  fillRectangle(other, -5, -5, 8, 8, {255, 0, 0});
  CHECK(other.at(0, 0) == Rgb{255, 0, 0});
  CHECK(other.at(4, 0) == kWhite);
}

TEST_CASE("too long a text becomes smaller until it fits") {
  CHECK_EQ(fittingCapHeight("short", 10, 1000), 10);
  const double fitting = fittingCapHeight("a very long title", 30, 100);
  CHECK_EQ(textWidth("a very long title", fitting), doctest::Approx(100));
}

TEST_CASE("a rectangle covers its edge pixels by their share") {
  Image image(4, 1);
  fillRectangle(image, 0.5, 0, 2, 1, {0, 0, 0});
  CHECK(image.at(0, 0) == Rgb{188, 188, 188});  // Half the light, in sRGB.
  CHECK(image.at(1, 0) == Rgb{0, 0, 0});
  CHECK(image.at(2, 0) == Rgb{188, 188, 188});
  CHECK(image.at(3, 0) == kWhite);
}

}  // namespace
}  // namespace asdfvk
