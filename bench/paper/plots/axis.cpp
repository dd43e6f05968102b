#include "paper/plots/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asdfvk::bench {
namespace {

constexpr double kSlack = 1e-9;
constexpr std::array<double, 3> kMantissas{1, 2, 5};
constexpr double kDecadesWithThreeTicks = 2.6;

/// Dividing by a whole power of ten gives the double nearest to the decimal number, multiplying by 0.1 does not.
double decimal(double mantissa, int exponent) {
  return exponent < 0 ? mantissa / std::pow(10.0, -exponent) : mantissa * std::pow(10.0, exponent);
}

/// All mantissa * 10^n, a decade beyond both ends.
std::vector<double> roundNumbers(double low, double high) {
  std::vector<double> numbers;
  const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
  for (int exponent = first; exponent <= last; ++exponent)
    for (const double mantissa : kMantissas) numbers.push_back(decimal(mantissa, exponent));
  return numbers;
}

}  // namespace

double Axis::shareOf(double value) const {
  if (isLogarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

bool Axis::holds(double value) const { return std::isfinite(value) && low <= value && value <= high; }

std::vector<Tick> axisTicks(const Axis& axis) {
  if (!axis.ticks.empty()) return axis.ticks;
  if (!axis.isLogarithmic) return ticksWithin({axis.low, axis.high});
  const bool hasAll = std::log10(axis.high / axis.low) <= kDecadesWithThreeTicks;
  std::vector<Tick> ticks;
  const std::vector<double> numbers = roundNumbers(axis.low, axis.high);
  for (size_t i = 0; i < numbers.size(); i += hasAll ? 1 : kMantissas.size())
    if (numbers[i] >= axis.low * (1 - kSlack) && numbers[i] <= axis.high * (1 + kSlack))
      ticks.push_back({numbers[i], fmt::format("{:g}", numbers[i])});
  return ticks;
}

Axis logarithmicAxis(std::string label, const std::vector<double>& values) {
  Axis axis{std::move(label), 0.1, 1, true, {}};
  std::vector<double> drawn;
  std::copy_if(values.begin(), values.end(), std::back_inserter(drawn),
               [](double value) { return std::isfinite(value) && value > 0; });
  if (drawn.empty()) return axis;
  const auto [least, greatest] = std::minmax_element(drawn.begin(), drawn.end());
  const std::vector<double> numbers = roundNumbers(*least, *greatest);
  const auto above = std::upper_bound(numbers.begin(), numbers.end(), *greatest * (1 - kSlack));
  const auto below = std::prev(std::upper_bound(numbers.begin(), numbers.end(), *least));
  axis.low = below < above ? *below : *std::prev(above);
  axis.high = *above;
  return axis;
}

}  // namespace asdfvk::bench
