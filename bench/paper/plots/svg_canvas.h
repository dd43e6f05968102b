#pragma once

#include <span>
#include <string>
#include <string_view>

namespace asdfvk::bench {

/// In pixels from the top left corner.
struct SvgPoint {
  double x = 0, y = 0;
};

enum class Anchor { Start, Middle, End };

struct Stroke {
  std::string_view colour = "#222222";
  double width = 1;
  bool isDashed = false;
};

/// An SVG 1.1 document on white, element after element; numbers with two decimals, so that it is the same everywhere.
class SvgCanvas {
 public:
  SvgCanvas(double width, double height, std::string_view title);

  void line(const SvgPoint& from, const SvgPoint& to, const Stroke& stroke);
  void chain(std::span<const SvgPoint> points, const Stroke& stroke);
  /// A filled shape of about 8 pixels: disk, square, diamond, triangle upwards, triangle downwards; repeating.
  void marker(const SvgPoint& centre, size_t shape, std::string_view colour);
  /// `place` is where the text's baseline starts, has its middle, or ends; it is turned about there.
  void text(const SvgPoint& place, std::string_view text, Anchor anchor, double size, std::string_view colour,
            double turnDegrees = 0);

  /// The document.
  [[nodiscard]] std::string finished() const;

 private:
  std::string body_;
};

}  // namespace asdfvk::bench
