#pragma once

#include <string>
#include <vector>

#include "render/ticks.h"

namespace asdfvk::bench {

/// One side of a plot. The ends are finite and low < high; of a logarithmic one they are above 0.
struct Axis {
  std::string label;
  double low = 0, high = 1;
  bool isLogarithmic = false;
  std::vector<Tick> ticks;  ///< Empty: axisTicks() chooses round ones.

  /// Where a value lies: 0 at `low`, 1 at `high`.
  [[nodiscard]] double shareOf(double value) const;
  /// Whether it can be drawn at all.
  [[nodiscard]] bool holds(double value) const;
};

/// Its own, or round ones within it: on a logarithmic axis 1, 2 and 5 times powers of ten, over many decades powers
/// only, with a thousandth from a hundredth told apart without exponents down to 0.0001.
[[nodiscard]] std::vector<Tick> axisTicks(const Axis& axis);

/// A logarithmic axis that holds all values above 0, from a 1, 2 or 5 times a power of ten to another. Without such
/// values it goes from 0.1 to 1.
[[nodiscard]] Axis logarithmicAxis(std::string label, const std::vector<double>& values);

}  // namespace asdfvk::bench
