#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cone/cone_value.h"
#include "core/check.h"
#include "core/random.h"

using namespace asdfvk;

namespace {

double valueOf(const std::vector<double>& lengths, const std::vector<double>& weights) {
  return coneValue(lengths, weights);
}

}  // namespace

TEST_CASE("no ray gives no value") { CHECK(std::isnan(valueOf({}, {}))); }

TEST_CASE("one ray gives its length") { CHECK(valueOf({3.5}, {2}) == 3.5); }

TEST_CASE("two rays are a tie and both count") {
  // Both are exactly one standard deviation from the median, up to rounding.
  CHECK(valueOf({1, 2}, {1, 3}) == doctest::Approx(1.75));
  for (int i = 1; i < 200; ++i) {
    const double a = 0.1 * i, b = 1 / (0.3 + i);
    CHECK(valueOf({a, b}, {1, 1}) == doctest::Approx(0.5 * (a + b)));
    CHECK(valueOf({a * 1e-20, b * 1e-20}, {1, 1}) == doctest::Approx(0.5e-20 * (a + b)).epsilon(1e-12));
  }
}

TEST_CASE("the median of an even count is the mean of the middle two") {
  // 0, 0, 4, 5: median 2, mean 2.25, deviation sqrt(5.1875) = 2.2776: 5 is 3 away and is dropped. With 0 or 4 as the
  // median, other rays would stay.
  CHECK(valueOf({5, 0, 4, 0}, {1, 1, 1, 1}) == doctest::Approx(4.0 / 3));
}

TEST_CASE("the window around the median does not depend on how the median is found") {
  Random random(3);
  for (size_t count = 1; count <= 70; ++count)
    for (const uint64_t differentCount : {2, 5, 1000}) {  // Few different lengths are many ties.
      std::vector<double> lengths(count);
      for (double& length : lengths) length = static_cast<double>(random.next() % differentCount) / 8;
      const auto medianOf = [&](std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return count % 2 == 1 ? values[count / 2] : 0.5 * (values[count / 2] + values[count / 2 - 1]);
      };
      const double median = medianOf(lengths);
      std::vector<double> deviations;
      for (const double length : lengths) deviations.push_back(std::abs(length - median));
      const LengthWindow window =
          keptWindow(lengths, {.spread = OutlierRule::Spread::MedianDeviation, .deviations = 1, .slack = 0});
      CAPTURE(count);
      CHECK(window.median == median);
      CHECK(window.bound == medianOf(deviations));
    }
}

TEST_CASE("an outlier is dropped and the weights count") {
  // 1, 1, 1, 2, 11: median 1, mean 3.2, deviation sqrt(15.36) = 3.919: only 11 is further than that.
  CHECK(valueOf({1, 2, 11, 1, 1}, {1, 5, 100, 1, 1}) == doctest::Approx((1 + 10 + 1 + 1) / 8.0));
}

TEST_CASE("the deviation is the population's") {
  // Median 3, mean 2.7, population deviation 1.4697, sample deviation 1.6432: 4.5 (1.5 away) is dropped only by the
  // population's.
  const std::vector<double> lengths = {0, 3, 3, 3, 4.5};
  CHECK(valueOf(lengths, {1, 1, 1, 1, 1}) == doctest::Approx(3));
}

TEST_CASE("equal lengths give that length") {
  const std::vector<double> lengths(30, 0.1), weights(30, 0.7);
  CHECK(valueOf(lengths, weights) == doctest::Approx(0.1).epsilon(1e-15));
  CHECK(valueOf(std::vector<double>(30, 0.0), weights) == 0);
}

TEST_CASE("CGAL's definition keeps lengths within one and a half median deviations, and is their plain mean") {
  const auto cgalValue = [](const std::vector<double>& lengths) {
    const Cone cone = makeCone({.rayCount = 25, .definition = Definition::Cgal});
    return coneValue(lengths, std::vector<double>(lengths.size(), 1), cone.outliers);
  };
  CHECK(std::isnan(cgalValue({})));
  CHECK(cgalValue({3.5}) == 3.5);
  CHECK(cgalValue({0, 10}) == 5);
  // Median 3, differences 0, 1, 1, 2, 97: the bound is 1.5.
  CHECK(cgalValue({4, 100, 1, 3, 2}) == 3);
  // Median 3, differences 1, 1, 2, 7: the bound is 2.25.
  CHECK(cgalValue({10, 1, 2, 4}) == doctest::Approx(7.0 / 3));
  // Median 5, differences 0, 2, 3, 4, 10: the bound is 4.5.
  CHECK(cgalValue({5, 3, 8, 1, 15}) == 4.25);
  // Median 6, differences 0, 1, 2, 2, 3, 6, 14: the bound is 3, which 9 has exactly.
  CHECK(cgalValue({4, 20, 8, 6, 0, 9, 5}) == doctest::Approx(6.4));
  // A difference of 0 in the middle keeps the equal lengths only.
  CHECK(cgalValue({5, 5, 5, 9}) == 5);
}

TEST_CASE("a weight for each length is a precondition") {
  CHECK_THROWS_AS(valueOf({1, 2}, {1}), CheckFailure);
  const std::vector<double> tooMany(kMaxRayCount + 1, 1.0);
  CHECK_THROWS_AS(valueOf(tooMany, tooMany), CheckFailure);
}
