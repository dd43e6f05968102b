#include "render/colour_bar.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/drawing.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxTickCount = 6;

/// Shortens the exponent: "2.5e-05" becomes "2.5e-5".
std::string shortExponent(std::string text) {
  const size_t e = text.find('e');
  if (e == std::string::npos) return text;
  size_t digits = e + 2;
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

std::vector<Tick> endsOf(const ColourRange& range) {
  const auto tick = [](double value) { return Tick{value, shortExponent(fmt::format("{:.4g}", value))}; };
  if (range.low == range.high) return {tick(range.low)};
  return {tick(range.low), tick(range.high)};
}

/// The distance between two ticks: mantissa * 10^exponent.
struct Step {
  double mantissa = 1;
  int exponent = 0;

  [[nodiscard]] double multiple(double n) const {
    // Division by a power of ten gives the double nearest to the decimal number; multiplication by 0.1 does not.
    return exponent < 0 ? n * mantissa / std::pow(10.0, -exponent) : n * mantissa * std::pow(10.0, exponent);
  }
  [[nodiscard]] int lastDigit() const { return mantissa == 2.5 ? exponent - 1 : exponent; }
};

/// The least and the greatest whole n for which n steps are within the range.
std::array<double, 2> multiplesWithin(const ColourRange& range, const Step& step) {
  const double slack = 1e-9;
  return {std::ceil(range.low / step.multiple(1) - slack), std::floor(range.high / step.multiple(1) + slack)};
}

Step stepFor(const ColourRange& range) {
  const int exponent = static_cast<int>(std::floor(std::log10((range.high - range.low) / kMaxTickCount)));
  for (int power = exponent;; ++power)
    for (const double mantissa : {1.0, 2.0, 2.5, 5.0}) {
      const Step step{mantissa, power};
      const auto [first, last] = multiplesWithin(range, step);
      if (last - first < double(kMaxTickCount)) return step;
    }
}

// Lengths relative to the height of capitals.
constexpr double kBarWidth = 1.3, kTickLength = 0.4, kLabelGap = 0.35, kTitleGap = 1.4;
constexpr double kHeightShare = 0.62, kWidestTitle = 1.0 / 3;

double labelWidth(const ColourBar& bar) {
  double widest = 0;
  for (const Tick& tick : ticksWithin(bar.range)) widest = std::max(widest, textWidth(tick.label, bar.capHeight));
  return widest;
}

double bodyWidth(const ColourBar& bar) {
  return (kBarWidth + kTickLength + kLabelGap) * bar.capHeight + labelWidth(bar);
}

Rgb colourAt(const ColourRange& range, double share) {
  const Rgba colour = colourOf(range.low + (range.high - range.low) * share, range);
  return {colour[0], colour[1], colour[2]};
}

}  // namespace

std::vector<Tick> ticksWithin(const ColourRange& range) {
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  const double span = range.high - range.low;
  if (!(span > 1e-8 * largest) || !std::isfinite(span) || span < 1e-290) return endsOf(range);
  const Step step = stepFor(range);
  const auto [first, last] = multiplesWithin(range, step);
  const int leading = static_cast<int>(std::floor(std::log10(largest)));
  const bool isScientific = leading < -3 || leading > 5;
  std::vector<Tick> ticks;
  for (double n = first; n <= last; ++n) {
    const double value = n == 0 ? 0 : step.multiple(n);
    std::string label = isScientific ? fmt::format("{:.{}e}", value, std::max(0, leading - step.lastDigit()))
                                     : fmt::format("{:.{}f}", value, std::max(0, -step.lastDigit()));
    ticks.push_back({std::clamp(value, range.low, range.high), value == 0 ? "0" : shortExponent(std::move(label))});
  }
  return ticks;
}

double columnWidth(const ColourBar& bar, double pictureWidth) {
  const double title = std::min(textWidth(bar.title, bar.capHeight), pictureWidth * kWidestTitle);
  return std::max(bodyWidth(bar), title);
}

void drawColourBar(Image& image, const ColourBar& bar, const PixelArea& column) {
  const double cap = bar.capHeight;
  // The sizes are whole pixels, so that there are no seams between the rows of the bar.
  const double height = std::max(1.0, std::round(column.height * kHeightShare));
  const double top = std::round(column.top + (column.height - height + kTitleGap * cap) / 2);
  const double left = column.left + (column.width - bodyWidth(bar)) / 2, width = kBarWidth * cap;
  const double line = std::max(1.0, cap / 16);

  const double titleCap = fittingCapHeight(bar.title, cap, column.width);
  drawText(image, bar.title, column.left + (column.width - textWidth(bar.title, titleCap)) / 2, top - kTitleGap * cap,
           titleCap);
  fillRectangle(image, left - line, top - line, width + 2 * line, height + 2 * line, kInk);
  for (double row = 0; row < height; ++row)
    fillRectangle(image, left, top + row, width, 1, colourAt(bar.range, 1 - (row + 0.5) / height));
  for (const Tick& tick : ticksWithin(bar.range)) {
    const double span = bar.range.high - bar.range.low;
    const double share = span > 0 ? (tick.value - bar.range.low) / span : 0.5;
    const double y = top + height * (1 - share);
    fillRectangle(image, left + width, y - line / 2, kTickLength * cap, line, kInk);
    drawText(image, tick.label, left + width + (kTickLength + kLabelGap) * cap, y + cap / 2, cap);
  }
}

}  // namespace asdfvk
