#include "paper/plots/svg_canvas.h"

#include <fmt/format.h>

#include <array>

#include "paper/plots/markup.h"

namespace asdfvk::bench {
namespace {

std::string attributesOf(const Stroke& stroke) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{} stroke-linejoin=\"round\"", stroke.colour,
                     stroke.width, stroke.isDashed ? " stroke-dasharray=\"5 3.5\"" : "");
}

std::string pointsText(std::span<const SvgPoint> points) {
  std::string text;
  for (const SvgPoint& point : points)
    text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", point.x, point.y);
  return text;
}

}  // namespace

SvgCanvas::SvgCanvas(double width, double height, std::string_view title) {
  body_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, escapeMarkup(title));
}

void SvgCanvas::line(const SvgPoint& from, const SvgPoint& to, const Stroke& stroke) {
  body_ += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", from.x, from.y, to.x,
                       to.y, attributesOf(stroke));
}

void SvgCanvas::chain(std::span<const SvgPoint> points, const Stroke& stroke) {
  body_ += fmt::format("<polyline points=\"{}\" {}/>\n", pointsText(points), attributesOf(stroke));
}

void SvgCanvas::marker(const SvgPoint& centre, size_t shape, std::string_view colour) {
  constexpr size_t kShapeCount = 5;
  const auto [x, y] = centre;
  const std::string fill = fmt::format("fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"0.8\"", colour);
  const auto polygon = [&](std::span<const SvgPoint> points) {
    body_ += fmt::format("<polygon points=\"{}\" {}/>\n", pointsText(points), fill);
  };
  switch (shape % kShapeCount) {
    case 0:
      body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" {}/>\n", x, y, fill);
      break;
    case 1:
      polygon(
          std::array<SvgPoint, 4>{{{x - 3.6, y - 3.6}, {x + 3.6, y - 3.6}, {x + 3.6, y + 3.6}, {x - 3.6, y + 3.6}}});
      break;
    case 2:
      polygon(std::array<SvgPoint, 4>{{{x, y - 5}, {x + 5, y}, {x, y + 5}, {x - 5, y}}});
      break;
    case 3:
      polygon(std::array<SvgPoint, 3>{{{x, y - 4.8}, {x + 4.6, y + 3.6}, {x - 4.6, y + 3.6}}});
      break;
    default:
      polygon(std::array<SvgPoint, 3>{{{x, y + 4.8}, {x + 4.6, y - 3.6}, {x - 4.6, y - 3.6}}});
  }
}

void SvgCanvas::text(const SvgPoint& place, std::string_view text, Anchor anchor, double size, std::string_view colour,
                     double turnDegrees) {
  constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
  const std::string turn =
      turnDegrees == 0 ? "" : fmt::format(" transform=\"rotate({:g} {:.2f} {:.2f})\"", turnDegrees, place.x, place.y);
  body_ +=
      fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" font-size=\"{:g}\" fill=\"{}\"{}>{}</text>\n",
                  place.x, place.y, kAnchors[static_cast<size_t>(anchor)], size, colour, turn, escapeMarkup(text));
}

std::string SvgCanvas::finished() const { return body_ + "</svg>\n"; }

}  // namespace asdfvk::bench
