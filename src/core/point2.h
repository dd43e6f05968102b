#pragma once

#include <compare>

namespace asdfvk {

struct Point2 {
  double x = 0, y = 0;
  auto operator<=>(const Point2&) const = default;
};

/// The side of p relative to the line from a to b: positive on the left, negative on the right, up to rounding.
[[nodiscard]] inline double sideOf(const Point2& a, const Point2& b, const Point2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

}  // namespace asdfvk
