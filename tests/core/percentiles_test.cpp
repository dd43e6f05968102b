#include "core/percentiles.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/random.h"

using namespace asdfvk;

namespace {

constexpr std::array<double, 7> kShares{0, 0.01, 0.25, 0.5, 0.5, 0.99, 1};

void checkAgainstSorted(const std::vector<double>& numbers) {
  std::vector<double> sorted;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(sorted), [](double n) { return std::isfinite(n); });
  std::sort(sorted.begin(), sorted.end());
  const std::vector<double> percentiles = percentilesOf(numbers, kShares);
  REQUIRE(percentiles.size() == kShares.size());
  for (size_t i = 0; i < kShares.size(); ++i) {
    CAPTURE(kShares[i]);
    CHECK(percentiles[i] ==
          sorted[static_cast<size_t>(std::llround(kShares[i] * static_cast<double>(sorted.size() - 1)))]);
  }
}

}  // namespace

TEST_CASE("percentiles are those of the sorted finite numbers") {
  using Limits = std::numeric_limits<double>;
  Random random(1);
  std::vector<double> both, positive, equal(70'000, 3.5), few{2, 1}, extreme;
  for (size_t i = 0; i < 200'000; ++i) both.push_back(random.real() - 0.3);
  for (size_t i = 0; i < 70'001; ++i) positive.push_back(std::exp(20 * random.real()));
  equal.push_back(4);
  for (size_t i = 0; i < 1000; ++i)
    extreme.push_back(i % 3 == 0 ? -Limits::max() : i % 3 == 1 ? Limits::max() : 1e-310);
  for (std::vector<double>* numbers : {&both, &positive, &equal, &few, &extreme}) {
    checkAgainstSorted(*numbers);
    numbers->insert(numbers->begin(), Limits::quiet_NaN());
    numbers->push_back(-Limits::infinity());
    numbers->push_back(Limits::infinity());
    checkAgainstSorted(*numbers);
  }
}

TEST_CASE("the median of an even count is the upper of the middle two") {
  CHECK(percentilesOf(std::vector<double>{4, 1, 3, 2}, std::array{0.5}).front() == 3);
}

TEST_CASE("without a finite number there are no percentiles") {
  CHECK(percentilesOf({}, kShares).empty());
  CHECK(percentilesOf(std::vector<double>{std::numeric_limits<double>::quiet_NaN()}, kShares).empty());
}
