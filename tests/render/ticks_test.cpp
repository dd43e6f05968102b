#include "render/colour_bar.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/random.h"

namespace asdfvk {
namespace {

std::string labelsOf(double low, double high) {
  std::string text;
  for (const Tick& tick : ticksWithin({low, high})) text += (text.empty() ? "" : " ") + tick.label;
  return text;
}

TEST_CASE("labels have as many digits as they need") {
  CHECK_EQ(labelsOf(0.06, 0.57), "0.1 0.2 0.3 0.4 0.5");
  CHECK_EQ(labelsOf(0, 1), "0 0.2 0.4 0.6 0.8 1.0");
  CHECK_EQ(labelsOf(0.012, 0.33), "0.05 0.10 0.15 0.20 0.25 0.30");
  CHECK_EQ(labelsOf(-1, 1), "-1.0 -0.5 0 0.5 1.0");
  CHECK_EQ(labelsOf(5.9, 49), "10 20 30 40");
  CHECK_EQ(labelsOf(0, 1.3e-5), "0 2.50e-6 5.00e-6 7.50e-6 1.00e-5 1.25e-5");
  CHECK_EQ(labelsOf(1e7, 5e7), "1e7 2e7 3e7 4e7 5e7");
  CHECK_EQ(labelsOf(-50, -10), "-50 -40 -30 -20 -10");
}

TEST_CASE("ticks are round, even and within the range whatever its size") {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    const double size = std::pow(10.0, random.real() * 40 - 20);
    const ColourRange range{(random.real() - 0.5) * size * 4, 0};
    const ColourRange full{range.low, range.low + size * (0.01 + random.real())};
    const std::vector<Tick> ticks = ticksWithin(full);
    CAPTURE(full.low);
    CAPTURE(full.high);
    REQUIRE_GE(ticks.size(), 3);
    REQUIRE_LE(ticks.size(), 6);
    const double step = ticks[1].value - ticks[0].value;
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    const double off =
        std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 2.5), std::abs(mantissa - 5)});
    CHECK_LT(off, 1e-6);
    std::set<std::string> labels;
    for (size_t i = 0; i < ticks.size(); ++i) {
      CHECK_GE(ticks[i].value, full.low);
      CHECK_LE(ticks[i].value, full.high);
      CHECK_EQ(ticks[i].value - ticks[0].value, doctest::Approx(step * double(i)));
      CHECK_LT(std::abs(std::stod(ticks[i].label) - ticks[i].value), 1e-6 * step);
      labels.insert(ticks[i].label);
    }
    CHECK_EQ(labels.size(), ticks.size());
  }
}

TEST_CASE("a range that is a point or next to one has its ends") {
  CHECK_EQ(labelsOf(0.25, 0.25), "0.25");
  CHECK_EQ(labelsOf(0, 0), "0");
  CHECK_EQ(labelsOf(1, 1 + 1e-12), "1 1");
  const double huge = std::numeric_limits<double>::max();
  CHECK_EQ(labelsOf(-huge, huge), "-1.798e308 1.798e308");
  CHECK_EQ(labelsOf(0, 5e-324), "0 4.941e-324");
}

}  // namespace
}  // namespace asdfvk
