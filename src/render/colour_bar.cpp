#include "render/colour_bar.h"

#include <algorithm>
#include <cmath>

#include "render/drawing.h"
#include "render/ticks.h"

namespace asdfvk {
namespace {

// Lengths divided by the height of capitals.
constexpr double kBarWidth = 1.3, kTickLength = 0.4, kLabelGap = 0.35, kTitleGap = 1.4;
constexpr double kHeightShare = 0.62, kWidestTitle = 1.0 / 3;

double labelWidth(const ColourBar& bar) {
  double widest = 0;
  for (const Tick& tick : ticksWithin(bar.range)) widest = std::max(widest, textWidth(tick.label, bar.capHeight));
  return widest;
}

/// Of bar, ticks and labels.
double bodyWidth(const ColourBar& bar) {
  return (kBarWidth + kTickLength + kLabelGap) * bar.capHeight + labelWidth(bar);
}

Rgb colourAt(const ColourRange& range, double share) {
  const Rgba colour = colourOf(range.low + (range.high - range.low) * share, range);
  return {colour[0], colour[1], colour[2]};
}

}  // namespace

double columnWidth(const ColourBar& bar, double pictureWidth) {
  const double title = std::min(textWidth(bar.title, bar.capHeight), pictureWidth * kWidestTitle);
  return std::max(bodyWidth(bar), title);
}

void drawColourBar(Image& image, const ColourBar& bar, const PixelArea& column) {
  const double cap = bar.capHeight;
  // Whole pixels, so that the rows of the bar leave no seams.
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
