#include "pipeline/rounds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "generate/shapes.h"
#include "pipeline/average_error.h"
#include "support/shapes.h"

using namespace asdfvk;
using test::averageError;
using test::referenceSession;

namespace {

Result computeRounds(const Mesh& mesh, const Options& options) { return referenceSession().compute(mesh, options); }

/// Begins with two percent, as the command line does.
Options roundsUntil(double maxError) {
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::ofShare(0.02);
  options.rounds.maxError = maxError;
  return options;
}

uint64_t markedCount(const Result& result) {
  return static_cast<uint64_t>(std::count(result.seed().begin(), result.seed().end(), 1));
}

bool isWithin(const std::vector<uint8_t>& few, const std::vector<uint8_t>& many) {
  for (size_t face = 0; face < few.size(); ++face)
    if (few[face] && !many[face]) return false;
  return true;
}

/// Spheres in a row, more than there are seeds in the first round.
Mesh manySpheres() {
  Mesh mesh = makeAnimal(1500).mesh;
  for (int i = 0; i < 30; ++i) mesh = shapes::joined(mesh, makeSphere(80, 0.1 + 0.01 * i).mesh, {3.0 + i, 0, 0});
  return mesh;
}

}  // namespace

TEST_CASE("rounds end when the estimated error is below the maximum, and so is the real error") {
  for (const std::string name : {"animal", "hand"}) {
    CAPTURE(name);
    const Mesh mesh = generateShape(name, 4000).mesh;
    const std::vector<double> truth = test::tracedEverywhere(mesh);
    for (const double maxError : {0.015, 0.01}) {
      const Result result = computeRounds(mesh, roundsUntil(maxError));
      REQUIRE(result.report.estimatedError);
      const ErrorEstimate& estimate = *result.report.estimatedError;
      const double real = averageError(result.sdf(), truth);
      MESSAGE(name, ": maximum ", maxError, ", real error ", real, " with ", result.report.seedCount, " seeds in ",
              result.report.roundCount, " rounds");
      CHECK(estimate.average <= maxError);
      CHECK(estimate.standardError > 0);
      CHECK(real <= 1.2 * maxError);
      CHECK(result.report.roundCount > 1);
      CHECK(result.report.roundCount < 10);
      CHECK(result.report.seedCount < mesh.faces.size());
      CHECK(markedCount(result) == result.report.seedCount);
      CHECK(result.report.rayCount == 30 * result.report.seedCount);
    }
  }
}

TEST_CASE("rounds end when the estimated median of the relative error is below its maximum, and so is the real one") {
  for (const std::string name : {"animal", "hand"}) {
    CAPTURE(name);
    const Mesh mesh = generateShape(name, 4000).mesh;
    const std::vector<double> truth = test::tracedEverywhere(mesh);
    Options options = roundsUntil(0.5);
    options.rounds.maxRelativeError = 0.012;
    const Result result = computeRounds(mesh, options);
    REQUIRE(result.report.estimatedError);
    const double real = test::relativeErrorAt(0.5, result.sdf(), truth);
    MESSAGE(name, ": real median ", real, " with ", result.report.seedCount, " seeds in ", result.report.roundCount);
    CHECK(result.report.estimatedError->relativeMedian <= 0.012);
    CHECK(real <= 1.2 * 0.012);
    CHECK(real > 0);
    CHECK(result.report.roundCount > 1);
    CHECK(result.report.seedCount < mesh.faces.size() / 2);
    // Both maxima hold where both are given.
    options.rounds.maxError = 0.008;
    const Result both = computeRounds(mesh, options);
    REQUIRE(both.report.estimatedError);
    CHECK(both.report.estimatedError->average <= 0.008);
    CHECK(both.report.estimatedError->relativeMedian <= 0.012);
  }
}

TEST_CASE("a first round that is good enough is the only one") {
  const Mesh mesh = makeAnimal(2500).mesh;
  const Result result = computeRounds(mesh, roundsUntil(0.5));
  CHECK(result.report.roundCount == 1);
  CHECK(result.report.seedCount == 51);
  Options plain = roundsUntil(0.5);
  plain.rounds = {};
  CHECK(computeRounds(mesh, plain).sdf() == result.sdf());
}

TEST_CASE("a further round keeps all seeds of the rounds before, whatever the sampler") {
  const Mesh mesh = makeAnimal(2500).mesh;
  for (const auto& sampler : kSamplerNames) {
    CAPTURE(sampler.first);
    Options options = roundsUntil(0.9);
    options.sampler = sampler.second;
    const Result first = computeRounds(mesh, options);
    CHECK(first.report.roundCount == (sampler.second == SamplerChoice::Adaptive ? 2u : 1u));
    for (const double maxError : {0.02, 0.012}) {
      options.rounds.maxError = maxError;
      const Result further = computeRounds(mesh, options);
      CHECK(further.report.roundCount > first.report.roundCount);
      CHECK(further.report.seedCount > first.report.seedCount);
      CHECK(isWithin(first.seed(), further.seed()));
      for (size_t face = 0; face < mesh.faces.size(); ++face)
        if (first.seed()[face]) CHECK(further.sdf()[face] == first.sdf()[face]);
    }
  }
}

TEST_CASE("an error that is out of reach makes every face a seed, and there is no estimate") {
  const Mesh mesh = makeTorus(1000).mesh;
  const Result result = computeRounds(mesh, roundsUntil(1e-9));
  CHECK(result.report.seedCount == mesh.faces.size());
  CHECK(markedCount(result) == mesh.faces.size());
  CHECK_FALSE(result.report.estimatedError.has_value());
  CHECK(result.sdf() == test::tracedEverywhere(mesh));
}

TEST_CASE("seeds that a round gave to components without one are not chosen again") {
  const Mesh mesh = manySpheres();
  for (const SamplerChoice sampler : {SamplerChoice::Random, SamplerChoice::BlueNoise, SamplerChoice::Adaptive}) {
    CAPTURE(nameOf(kSamplerNames, sampler));
    for (const double maxError : {0.005, 1e-9}) {
      Options options = roundsUntil(maxError);
      options.seeds = SeedCount::ofShare(0.005);
      options.sampler = sampler;
      const Result result = computeRounds(mesh, options);
      CHECK(result.report.roundCount > 1);
      CHECK(result.report.seedCount == markedCount(result));
      CHECK(result.report.noValueCount == 0);
    }
    Options once;
    once.seeds = SeedCount::ofShare(0.02);
    once.sampler = sampler;
    const Result result = computeRounds(mesh, once);
    CHECK(result.report.seedCount == markedCount(result));
  }
}

TEST_CASE("the adaptive sampler casts as many rays in two rounds, and its error is not larger") {
  const Mesh mesh = makeHand(4000).mesh;
  const std::vector<double> truth = test::tracedEverywhere(mesh);
  Options adaptive = test::tenthOfFaces();
  adaptive.sampler = SamplerChoice::Adaptive;
  const Result blueNoise = computeRounds(mesh, test::tenthOfFaces()), twoPasses = computeRounds(mesh, adaptive);
  CHECK(twoPasses.report.roundCount == 2);
  CHECK(twoPasses.report.seedCount == blueNoise.report.seedCount);
  CHECK(twoPasses.seed() != blueNoise.seed());
  CHECK(averageError(twoPasses.sdf(), truth) < 1.1 * averageError(blueNoise.sdf(), truth));
  Options all = adaptive;
  all.seeds = SeedCount::all();
  CHECK(computeRounds(mesh, all).report.roundCount == 1);
}

TEST_CASE("adaptive seeds are as many as requested where no estimate is requested") {
  const Mesh mesh = makeAnimal(2500).mesh;
  Options options = test::tenthOfFaces();
  options.estimatesError = false;
  const uint64_t requested = computeRounds(mesh, options).report.seedCount;
  options.sampler = SamplerChoice::Adaptive;
  const Result result = computeRounds(mesh, options);
  CHECK_FALSE(result.report.estimatedError.has_value());
  CHECK(result.report.roundCount == 2);
  CHECK(result.report.seedCount == requested);
  CHECK(result.report.stageSeconds[Stage::Estimate] == 0);
}

TEST_CASE("seeds too few to hold any out give no estimate, and those that are enough do") {
  const Mesh mesh = makeAnimal(2500).mesh;
  Options options = test::tenthOfFaces();
  for (const SamplerChoice sampler : {SamplerChoice::BlueNoise, SamplerChoice::Adaptive})
    for (const uint64_t count : {1, 2, 3, 9, 40}) {
      CAPTURE(nameOf(kSamplerNames, sampler));
      CAPTURE(count);
      options.sampler = sampler;
      options.seeds = SeedCount::ofCount(count);
      const Result result = computeRounds(mesh, options);
      CHECK(result.report.seedCount == count);
      CHECK(result.report.noValueCount == 0);
      CHECK((result.report.stageSeconds[Stage::Estimate] > 0) == (count >= 4));
      CHECK(result.report.estimatedError.has_value() == (count >= 9));
    }
}

TEST_CASE("without a prediction, random seeds do not depend on the estimate") {
  const Mesh mesh = makeAnimal(2500).mesh;
  Options options = test::tenthOfFaces();
  applyRecipe(Recipe::Paper, options);
  const Result with = computeRounds(mesh, options);
  options.estimatesError = false;
  const Result without = computeRounds(mesh, options);
  CHECK(with.seed() == without.seed());
  CHECK(with.sdf() == without.sdf());
}

TEST_CASE("an estimate costs no accuracy: held-out faces lie where seeds lower the error" *
          doctest::test_suite("slow")) {
  double logarithms = 0;
  int runCount = 0;
  for (const std::string name : {"animal", "hand", "figure"}) {
    const Mesh mesh = generateShape(name, 4000).mesh;
    const std::vector<double> truth = test::tracedEverywhere(mesh);
    for (const uint64_t randomSeed : {1u, 2u, 3u, 4u}) {
      Options options = test::tenthOfFaces();
      options.randomSeed = randomSeed;
      const double with = averageError(computeRounds(mesh, options).sdf(), truth);
      options.estimatesError = false;
      logarithms += std::log(with / averageError(computeRounds(mesh, options).sdf(), truth));
      ++runCount;
    }
  }
  MESSAGE("the error with an estimate over that without: ", std::exp(logarithms / runCount));
  CHECK(logarithms < 0);
}

TEST_CASE("rounds give the same bits each time") {
  const Mesh mesh = makeAnimal(2500).mesh;
  const Result one = computeRounds(mesh, roundsUntil(0.015)), two = computeRounds(mesh, roundsUntil(0.015));
  CHECK(one.sdf() == two.sdf());
  CHECK(one.seed() == two.seed());
  CHECK(test::expectedErrors(one) == test::expectedErrors(two));
}

TEST_CASE("rounds can be stopped between one and the next, and their progress ends at 1") {
  const Mesh mesh = makeAnimal(2500).mesh;
  std::vector<double> fractions;
  const RunControl watched{{}, [&](double fraction) { fractions.push_back(fraction); }};
  (void)referenceSession().compute(mesh, roundsUntil(0.015), watched);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.back() == 1);
}
