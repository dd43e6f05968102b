#include "render/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace asdfvk {
namespace {

/// First and last whole number i in [begin, end) with low <= i + 0.5 <= high; the last is below the first without one.
std::pair<int, int> centresWithin(double low, double high, int begin, int end) {
  const double first = std::clamp(std::ceil(low - 0.5), double(begin), double(end));
  const double last = std::clamp(std::floor(high - 0.5), double(begin) - 1, double(end) - 1);
  return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace

SampleRows::SampleRows(int width, int top, int bottom) : width_(width), top_(top), bottom_(bottom) {
  const auto count = static_cast<size_t>(width) * static_cast<size_t>(bottom - top);
  depths_.assign(count, -std::numeric_limits<float>::infinity());
  indices_.assign(count, kNoSample);
}

void SampleRows::draw(uint32_t index, const Projected& a, const Projected& b, const Projected& c) {
  const auto [low, high] = std::minmax({a.y, b.y, c.y});
  const auto [firstRow, lastRow] = centresWithin(low, high, top_, bottom_);
  if (firstRow > lastRow) return;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [firstColumn, lastColumn] = centresWithin(left, right, 0, width_);
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0) return;
  for (int row = firstRow; row <= lastRow; ++row)
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      const double ofA = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
      const double ofB = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
      const double ofC = 1 - ofA - ofB;
      if (ofA < 0 || ofB < 0 || ofC < 0) continue;
      const auto depth = static_cast<float>(ofA * a.depth + ofB * b.depth + ofC * c.depth);
      const size_t sample = placeOf(column, row);
      if (depth <= depths_[sample]) continue;
      depths_[sample] = depth;
      indices_[sample] = index;
    }
}

}  // namespace asdfvk
