#include "segment/soft_clustering.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "asdf_vk/options.h"
#include "sample_problems.h"
#include "support/require_failure.h"

using namespace asdfvk;

namespace {

using Values = std::vector<double>;

/// `perCluster` numbers around each mean, normally distributed.
Values numbersAround(const Values& means, double deviation, uint32_t perCluster) {
  Random random(3);
  Values values;
  for (uint32_t i = 0; i < perCluster; ++i)
    for (const double mean : means) {
      double sum = 0;  // Irwin-Hall: variance 1.
      for (int n = 0; n < 12; ++n) sum += random.real() - 0.5;
      values.push_back(mean + deviation * sum);
    }
  return values;
}

}  // namespace

TEST_CASE("the first seed is drawn by the second number of rand48") {
  // There are as many clusters as different values. Every value becomes a centre that never moves.
  Values values(20);
  std::iota(values.begin(), values.end(), 0.0);
  const HardClustering clustering = clusterByMeans(values, 20);
  srand48(1340818006);
  static_cast<void>(lrand48());
  CHECK(clustering.centres[0] == static_cast<double>(lrand48() / ((1L << 31) / 20)));
  Values sorted = clustering.centres;
  std::sort(sorted.begin(), sorted.end());
  CHECK(sorted == values);
}

TEST_CASE("further seeds are drawn by the squares of the distances") {
  const Values values{0, 1, 10, 11, 30};
  srand48(1340818006);
  static_cast<void>(lrand48());
  Values seeds{values[static_cast<size_t>(lrand48() / ((1L << 31) / 5))]};
  while (seeds.size() < 5) {
    Values squares;
    for (const double value : values) {
      double least = INFINITY;
      for (const double seed : seeds) least = std::min(least, std::pow(value - seed, 2));
      squares.push_back(least);
    }
    const double total = std::accumulate(squares.begin(), squares.end(), 0.0);
    double target = static_cast<double>(lrand48()) / static_cast<double>(1L << 31) * total;
    size_t chosen = 0;
    for (double sum = squares[0]; !(sum > target); sum += squares[++chosen]) {
    }
    seeds.push_back(values[chosen]);
  }
  CHECK(clusterByMeans(values, 5).centres == seeds);
}

TEST_CASE("k-means ends at the means of the nearest values") {
  const HardClustering clustering = clusterByMeans(Values{0, 1, 2, 100, 101, 105}, 2);
  Values centres = clustering.centres;
  std::sort(centres.begin(), centres.end());
  CHECK(centres == Values{1, 102});
  CHECK(clustering.clusterOf[0] == clustering.clusterOf[2]);
  CHECK(clustering.clusterOf[0] != clustering.clusterOf[3]);
}

TEST_CASE("separate clusters are found with their means, deviations and weights, in ascending order") {
  Values values = numbersAround({0.2, 0.5, 0.8}, 0.02, 4000);
  const Values more = numbersAround({0.8}, 0.02, 4000);
  values.insert(values.end(), more.begin(), more.end());
  const SoftClustering clustering = clusterSoftly(values, 3);
  const Values means{0.2, 0.5, 0.8}, weights{0.25, 0.25, 0.5};
  for (size_t c = 0; c < 3; ++c) {
    CHECK(clustering.means[c] == doctest::Approx(means[c]).epsilon(0.01));
    CHECK(clustering.deviations[c] == doctest::Approx(0.02).epsilon(0.05));
    CHECK(clustering.weights[c] == doctest::Approx(weights[c]).epsilon(0.01));
  }
  for (size_t i = 0; i < values.size(); ++i) {
    const double* row = &clustering.probabilities[3 * i];
    REQUIRE(row[0] + row[1] + row[2] == doctest::Approx(1).epsilon(1e-14));
  }
  CHECK(clustering.probabilities[0] > 0.999);
  CHECK(clustering.probabilities[4] > 0.999);
}

TEST_CASE("the means of overlapping clusters ascend") {
  const SoftClustering clustering = clusterSoftly(numbersAround({0.4, 0.5}, 0.1, 1000), 6);
  CHECK(std::is_sorted(clustering.means.begin(), clustering.means.end()));
}

TEST_CASE("clusters of equal values have deviation 0 and no other values") {
  const SoftClustering clustering = clusterSoftly(Values{0, 0, 0, 1, 1, 5}, 3);
  CHECK(clustering.means == Values{0, 1, 5});
  CHECK(clustering.deviations == Values{0, 0, 0});
  CHECK(clustering.probabilities == Values{1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1});
}

TEST_CASE("one cluster has every value") {
  const SoftClustering clustering = clusterSoftly(Values{1, 2, 3}, 1);
  CHECK(clustering.means == Values{2});
  CHECK(clustering.weights == Values{1});
  CHECK(clustering.probabilities == Values{1, 1, 1});
}

TEST_CASE("probabilities are numbers also where a value is far from each cluster") {
  Values values(1000, 0.0);
  for (size_t i = 500; i < 1000; ++i) values[i] = 1e-6;
  values[999] = 1;
  for (const double p : clusterSoftly(values, 2).probabilities) REQUIRE((p >= 0 && p <= 1));
}

TEST_CASE("fewer different values than clusters are refused") {
  const Values values{3, 3, 5, 3, 5};
  CHECK(clusterSoftly(values, 2).means == Values{3, 5});
  test::requireFailure([&] { static_cast<void>(clusterSoftly(values, 3)); }, ErrorCode::TooFewValues, "3");
  test::requireFailure([&] { static_cast<void>(clusterSoftly({}, 1)); }, ErrorCode::TooFewValues);
  test::requireFailure([&] { static_cast<void>(clusterSoftly(Values{0, 1e-200}, 2)); }, ErrorCode::TooFewValues);
}
