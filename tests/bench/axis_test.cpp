#include "paper/plots/axis.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace asdfvk::bench {
namespace {

std::string labelsOf(const Axis& axis) {
  std::string text;
  for (const Tick& tick : axisTicks(axis)) text += (text.empty() ? "" : " ") + tick.label;
  return text;
}

TEST_CASE("ticks of logarithmic axes are round") {
  CHECK_EQ(labelsOf({"", 1, 100, true, {}}), "1 2 5 10 20 50 100");
  CHECK_EQ(labelsOf({"", 0.005, 0.2, true, {}}), "0.005 0.01 0.02 0.05 0.1 0.2");
  CHECK_EQ(labelsOf({"", 0.001, 1000, true, {}}), "0.001 0.01 0.1 1 10 100 1000");
  CHECK_EQ(labelsOf({"", 0, 1, false, {}}), "0 0.2 0.4 0.6 0.8 1.0");
}

TEST_CASE("an axis that is given its ticks keeps them") {
  CHECK_EQ(labelsOf({"", -0.3, 1.3, false, {{0, "horse"}, {1, "cow"}}}), "horse cow");
}

TEST_CASE("shares are even in the axis's own measure") {
  const Axis logarithmic{"", 1, 100, true, {}}, linear{"", 1, 101, false, {}};
  CHECK_EQ(logarithmic.shareOf(10), doctest::Approx(0.5));
  CHECK_EQ(linear.shareOf(26), doctest::Approx(0.25));
  CHECK(linear.holds(1));
  CHECK(linear.holds(101));
  CHECK_FALSE(linear.holds(101.5));
  CHECK_FALSE(logarithmic.holds(0));
  CHECK_FALSE(logarithmic.holds(std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("a logarithmic axis holds all positive values between neighbouring round numbers") {
  Random random(1);
  for (int round = 0; round < 1000; ++round) {
    const double least = std::pow(10.0, random.real() * 12 - 6), greatest = least * (1 + 500 * random.real());
    const Axis axis = logarithmicAxis("", {greatest, least, 0, -1, std::nan("")});
    CAPTURE(least);
    CAPTURE(greatest);
    CHECK_LT(axis.low, axis.high);
    CHECK(axis.holds(least));
    CHECK(axis.holds(greatest));
    CHECK_GT(axis.low, least / 2.6);
    CHECK_LT(axis.high, greatest * 2.6);
    CHECK_GE(axisTicks(axis).size(), 2);
  }
}

TEST_CASE("values on round numbers are the ends, and a single one makes no empty axis") {
  const Axis ends = logarithmicAxis("", {0.01, 0.1});
  CHECK_EQ(ends.low, 0.01);
  CHECK_EQ(ends.high, 0.1);
  const Axis one = logarithmicAxis("", {0.1});
  CHECK_LT(one.low, one.high);
  CHECK(one.holds(0.1));
  const Axis none = logarithmicAxis("", {0, -1});
  CHECK_LT(none.low, none.high);
}

}  // namespace
}  // namespace asdfvk::bench
