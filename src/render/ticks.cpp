#include "render/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asdfvk {
namespace {

constexpr size_t kMaxTickCount = 6;

/// "2.5e-05" to "2.5e-5".
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

/// A step of mantissa * 10^exponent.
struct Step {
  double mantissa = 1;
  int exponent = 0;

  [[nodiscard]] double multiple(double n) const {
    // Division by a power of ten gives the double nearest to the decimal number; multiplication by 0.1 does not.
    return exponent < 0 ? n * mantissa / std::pow(10.0, -exponent) : n * mantissa * std::pow(10.0, exponent);
  }
  [[nodiscard]] int lastDigit() const { return mantissa == 2.5 ? exponent - 1 : exponent; }
};

/// First and last whole multiple of the step within the range.
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

}  // namespace asdfvk
