#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/check.h"
#include "core/vec3.h"

namespace asdfvk {

using Rgb = std::array<uint8_t, 3>;
inline constexpr Rgb kWhite{255, 255, 255}, kInk{34, 34, 34};
/// Colour of a body without values.
inline constexpr Rgb kNeutral{210, 209, 204};

/// A picture: rows from the top, with pixels from the left.
class Image {
 public:
  /// A white image. Precondition: both sizes are at least 1.
  Image(int width, int height) : width_(width), height_(height) {
    ASDFVK_CHECK(width > 0 && height > 0);
    pixels_.assign(static_cast<size_t>(width) * static_cast<size_t>(height), kWhite);
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] bool holds(int x, int y) const { return 0 <= x && x < width_ && 0 <= y && y < height_; }
  /// Precondition: holds(x, y).
  [[nodiscard]] const Rgb& at(int x, int y) const { return pixels_[indexOf(x, y)]; }
  [[nodiscard]] Rgb& at(int x, int y) { return pixels_[indexOf(x, y)]; }
  [[nodiscard]] const std::vector<Rgb>& pixels() const { return pixels_; }
  bool operator==(const Image&) const = default;

 private:
  [[nodiscard]] size_t indexOf(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  int width_, height_;
  std::vector<Rgb> pixels_;
};

// Light is added in linear sRGB; 1 is white.

[[nodiscard]] Vec3d toLinear(const Rgb& colour);
/// Values outside [0, 1] are clamped.
[[nodiscard]] Rgb toRgb(const Vec3d& linear);
/// Blends `share` of `over` onto `under`.
[[nodiscard]] Rgb blend(const Rgb& under, const Rgb& over, double share);

}  // namespace asdfvk
