#include "smooth/bilateral.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "asdf_vk/error.h"
#include "sample_fields.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/stopped_control.h"

using namespace asdfvk;
using test::kNaN;

namespace {

// The definition in bilateral.h, written out.
double definedValue(const DualGraph& graph, const std::vector<double>& values, uint32_t face, uint32_t window) {
  const std::vector<uint32_t> ring = test::hopsFrom(graph, face, window);
  double squares = 0, count = 0;
  for (uint32_t g = 0; g < graph.faceCount(); ++g)
    if (ring[g] <= window && !std::isnan(values[g])) {
      squares += std::pow(values[g] - values[face], 2);
      ++count;
    }
  const double sigma = std::sqrt(squares / count), ringSigma = window / 2.0;
  double weights = 0, sum = 0;
  for (uint32_t g = 0; g < graph.faceCount(); ++g)
    if (ring[g] <= window && !std::isnan(values[g])) {
      const double weight = std::exp(-std::pow(ring[g], 2) / (2 * std::pow(ringSigma, 2))) *
                            std::exp(-std::pow(values[g] - values[face], 2) / (2 * std::pow(sigma, 2)));
      weights += weight;
      sum += weight * values[g];
    }
  return sum / weights;
}

double variance(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (double value : values) sum += value;
  const double count = static_cast<double>(values.size());
  for (double value : values) squares += std::pow(value - sum / count, 2);
  return squares / count;
}

}  // namespace

TEST_CASE("three faces in a row have the values computed by hand") {
  const std::vector<double> smoothed = smoothBilaterally(test::stripGraph(3), std::vector<double>{0, 1, 3}, {1, 1});
  // Differences -1, 0, 2, so sigma^2 = 5/3; ring 1 has exp(-1 / (2 * 0.25)).
  const double left = std::exp(-2.0) * std::exp(-0.3), right = std::exp(-2.0) * std::exp(-1.2);
  CHECK(smoothed[1] == doctest::Approx(1 + (-left + 2 * right) / (1 + left + right)).epsilon(1e-14));
  // One neighbour at distance d: sigma^2 = d^2 / 2.
  const double weight = std::exp(-2.0) * std::exp(-1.0);
  CHECK(smoothed[0] == doctest::Approx(weight / (1 + weight)).epsilon(1e-14));
}

TEST_CASE("every face has the value of the definition, also around faces without a value") {
  const DualGraph graph = test::torusGraph(600);
  std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
  for (uint32_t face = 0; face < graph.faceCount(); face += 11) values[face] = kNaN;
  for (uint32_t window : {1u, 2u, 3u, 4u}) {
    const std::vector<double> smoothed = smoothBilaterally(graph, values, {window, 1});
    REQUIRE(smoothed.size() == values.size());
    for (uint32_t face = 0; face < graph.faceCount(); ++face) {
      CAPTURE(face);
      if (face % 11 == 0)
        REQUIRE(std::isnan(smoothed[face]));
      else
        REQUIRE(smoothed[face] == doctest::Approx(definedValue(graph, values, face, window)).epsilon(1e-12));
    }
  }
}

TEST_CASE("a constant field, an isolated face and a face whose neighbours have no value do not change") {
  const DualGraph graph = test::torusGraph(600);
  const std::vector<double> constant(graph.faceCount(), 0.1);
  CHECK(smoothBilaterally(graph, constant, {2, 3}) == constant);
  CHECK(smoothBilaterally(test::graphOf({{}, {2}, {1}}), std::vector<double>{7.3, 1, 1}, {4, 2}) ==
        std::vector<double>{7.3, 1, 1});
  const std::vector<double> amongNone =
      smoothBilaterally(test::stripGraph(3), std::vector<double>{kNaN, 7.3, kNaN}, {2, 2});
  CHECK(amongNone[1] == 7.3);
  CHECK(std::isnan(amongNone[0]));
  CHECK(std::isnan(amongNone[2]));
  CHECK(smoothBilaterally(test::graphOf({}), std::vector<double>{}, {2, 1}).empty());
}

TEST_CASE("noise decreases, more so with more rings and with another pass") {
  const DualGraph graph = test::torusGraph(5000);
  const std::vector<double> values = test::noisyField(graph.faceCount(), 3, 0.1);
  const auto left = [&](const SmoothingOptions::Window& options) {
    return variance(smoothBilaterally(graph, values, options)) / variance(values);
  };
  const double narrow = left({1, 1}), wide = left({2, 1}), twice = left({2, 2});
  CHECK(narrow < 0.8);
  CHECK(wide < 0.45);
  CHECK(wide < narrow);
  CHECK(twice < 0.7 * wide);
  CHECK(left({2, 0}) == 1);
}

TEST_CASE("a step much larger than the noise is kept, the noise beside it decreases") {
  const uint32_t faceCount = 2000;
  const DualGraph graph = test::stripGraph(faceCount);
  std::vector<double> values = test::noisyField(faceCount, 1, 0.02);
  for (uint32_t face = faceCount / 2; face < faceCount; ++face) values[face] += 10;
  const std::vector<double> smoothed = smoothBilaterally(graph, values, {2, 1});
  for (uint32_t face = 0; face < faceCount; ++face) {
    const double level = face < faceCount / 2 ? 1 : 11;
    const bool isBesideStep = face + 2 >= faceCount / 2 && face < faceCount / 2 + 2;
    // A mean with the weights of the rings alone would be off by 0.33.
    REQUIRE(std::abs(smoothed[face] - level) < (isBesideStep ? 0.15 * 10 : 0.02));
  }
  const auto far = [&](const std::vector<double>& field) {
    return variance({field.begin(), field.begin() + faceCount / 2 - 10});
  };
  CHECK(far(smoothed) < 0.6 * far(values));
}

TEST_CASE("a unit that is a power of two does not change the relative bits") {
  const DualGraph graph = test::torusGraph(600);
  const std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
  const std::vector<double> expected = smoothBilaterally(graph, values, {2, 2});
  for (double unit : {0x1p-900, 0x1p-10, 0x1p900}) {
    std::vector<double> scaled = values;
    for (double& value : scaled) value *= unit;
    scaled = smoothBilaterally(graph, scaled, {2, 2});
    for (double& value : scaled) value /= unit;
    CHECK(test::haveSameBits(scaled, expected));
  }
}

TEST_CASE("a pass filters the result of the pass before, and 0 passes change nothing") {
  const DualGraph graph = test::torusGraph(600);
  const std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
  const std::vector<double> once = smoothBilaterally(graph, values, {2, 1});
  CHECK(once != values);
  CHECK(smoothBilaterally(graph, values, {2, 2}) == smoothBilaterally(graph, once, {2, 1}));
  CHECK(smoothBilaterally(graph, values, {2, 0}) == values);
}

TEST_CASE("the bits are the same on any number of threads") {
  const DualGraph graph = test::torusGraph(20000);
  const std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
  const auto onThreads = [&](size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return smoothBilaterally(graph, values, {2, 2});
  };
  const std::vector<double> alone = onThreads(1);
  for (size_t count : {2u, 4u}) CHECK(test::haveSameBits(onThreads(count), alone));
}

TEST_CASE("the automatic window grows with the number of faces") {
  CHECK(smoothingWindowFor(0) == SmoothingOptions::Window{1, 1});
  CHECK(smoothingWindowFor(9'999) == SmoothingOptions::Window{1, 1});
  CHECK(smoothingWindowFor(10'000) == SmoothingOptions::Window{2, 1});
  CHECK(smoothingWindowFor(89'999) == SmoothingOptions::Window{2, 1});
  CHECK(smoothingWindowFor(90'000) == SmoothingOptions::Window{2, 2});
  CHECK(smoothingWindowFor(~uint64_t{0}) == SmoothingOptions::Window{2, 2});
}

TEST_CASE("a number of rings out of range is refused") {
  for (uint32_t ringCount : {0u, 5u, ~0u}) {
    try {
      static_cast<void>(smoothBilaterally(test::stripGraph(3), std::vector<double>{1, 2, 3}, {ringCount, 1}));
      FAIL_CHECK("accepted");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::OptionOutOfRange);
    }
  }
}

TEST_CASE("a stop request ends the filter") {
  test::requireFailure(
      [] {
        (void)smoothBilaterally(test::stripGraph(3), std::vector<double>{1, 2, 3}, {2, 1}, test::stoppedControl());
      },
      ErrorCode::Cancelled);
}
