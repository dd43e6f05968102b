#include "render/panels.h"

#include <algorithm>
#include <cmath>

#include "render/drawing.h"

namespace asdfvk {
namespace {

constexpr double kCaptionHeightShare = 0.036;  ///< Of the captions, over the highest panel.

void paste(Image& target, const Image& source, int left, int top) {
  for (int y = 0; y < source.height(); ++y)
    for (int x = 0; x < source.width(); ++x) target.at(left + x, top + y) = source.at(x, y);
}

}  // namespace

Image composeRow(std::span<const Panel> panels) {
  ASDFVK_CHECK(!panels.empty());
  int width = 0, height = 0;
  bool hasCaption = false;
  for (const Panel& panel : panels) {
    width += panel.image.width();
    height = std::max(height, panel.image.height());
    hasCaption |= !panel.caption.empty();
  }
  const double capHeight = height * kCaptionHeightShare;
  const int captionHeight = hasCaption ? static_cast<int>(std::ceil(capHeight * 2.5)) : 0;
  Image row(width, height + captionHeight);
  int left = 0;
  for (const Panel& panel : panels) {
    paste(row, panel.image, left, (height - panel.image.height()) / 2);
    const double own = panel.image.width();
    const double cap = fittingCapHeight(panel.caption, capHeight, own * 0.95);
    drawText(row, panel.caption, left + (own - textWidth(panel.caption, cap)) / 2, height + capHeight, cap);
    left += panel.image.width();
  }
  return row;
}

}  // namespace asdfvk
