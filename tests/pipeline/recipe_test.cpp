#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "asdf_vk/options.h"
#include "generate/shapes.h"
#include "pipeline/average_error.h"

using namespace asdfvk;
using test::averageError;
using test::referenceSession;

namespace {

Options optionsOf(Recipe recipe) {
  Options options;
  applyRecipe(recipe, options);
  return options;
}

/// Mean error of the values of the recipe over three random seeds.
double errorBy(Recipe recipe, const Mesh& mesh, const std::vector<double>& truth) {
  constexpr uint64_t kRunCount = 3;
  double sum = 0;
  for (uint64_t run = 1; run <= kRunCount; ++run) {
    Options options = optionsOf(recipe);
    options.seeds = SeedCount::ofShare(0.1);
    options.randomSeed = run;
    sum += averageError(referenceSession().compute(mesh, options).sdf(), truth);
  }
  return sum / kRunCount;
}

}  // namespace

TEST_CASE("paper is the method of the paper") {
  const Options options = optionsOf(Recipe::Paper);
  CHECK(options.sampler == SamplerChoice::Random);
  CHECK(options.interpolation.weights == ArcWeights::Distance);
  CHECK(options.interpolation.guidance == Guidance::Curvature);
  CHECK(options.interpolation.pooling == 0);
  CHECK(options.cone.rotation == ConeRotation::Fixed);
}

TEST_CASE("balanced is the default") {
  const Options options = optionsOf(Recipe::Balanced), defaults;
  CHECK(options.sampler == SamplerChoice::BlueNoise);
  CHECK(options.interpolation.weights == ArcWeights::Feature);
  CHECK(options.interpolation.guidance == Guidance::Prediction);
  CHECK(options.interpolation.pooling == 0);
  CHECK(options.cone.rotation == ConeRotation::Fixed);
  CHECK(options.sampler == defaults.sampler);
  CHECK(options.interpolation.weights == defaults.interpolation.weights);
  CHECK(options.interpolation.guidance == defaults.interpolation.guidance);
}

TEST_CASE("quality is balanced with hashed cones and pooled values") {
  const Options options = optionsOf(Recipe::Quality);
  CHECK(options.sampler == SamplerChoice::BlueNoise);
  CHECK(options.interpolation.weights == ArcWeights::Feature);
  CHECK(options.interpolation.guidance == Guidance::Prediction);
  CHECK(options.interpolation.pooling > 0);
  CHECK(options.cone.rotation == ConeRotation::Hashed);
}

TEST_CASE("a recipe replaces another one and changes no other option") {
  for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced, Recipe::Quality}) {
    Options options;
    options.seeds = SeedCount::ofShare(0.3);
    options.randomSeed = 77;
    options.cone.rayCount = 12;
    options.cone.openingAngleDegrees = 100;
    options.solver = SolverChoice::Eigen;
    options.solverOptions.tolerance = 1e-7;
    options.estimatesError = false;
    options.rounds.maxError = 0.5;
    options.orientation = Orientation::Flip;
    options.checkCount = 5;
    for (const Recipe earlier : {Recipe::Quality, Recipe::Paper}) applyRecipe(earlier, options);
    applyRecipe(recipe, options);
    const Options expected = optionsOf(recipe);
    CHECK(options.sampler == expected.sampler);
    CHECK(options.cone.rotation == expected.cone.rotation);
    CHECK(options.interpolation.weights == expected.interpolation.weights);
    CHECK(options.interpolation.guidance == expected.interpolation.guidance);
    CHECK(options.interpolation.pooling == expected.interpolation.pooling);
    CHECK(options.seeds.share == 0.3);
    CHECK(options.randomSeed == 77);
    CHECK(options.cone.rayCount == 12);
    CHECK(options.cone.openingAngleDegrees == 100);
    CHECK(options.solver == SolverChoice::Eigen);
    CHECK(options.solverOptions.tolerance == 1e-7);
    CHECK_FALSE(options.estimatesError);
    CHECK(options.rounds.maxError == 0.5);
    CHECK(options.orientation == Orientation::Flip);
    CHECK(options.checkCount == 5);
  }
}

TEST_CASE("balanced errs less than paper" * doctest::test_suite("slow")) {
  for (const std::string name : {"animal", "hand", "figure"}) {
    const Mesh mesh = generateShape(name, 10'000).mesh;
    const std::vector<double> truth = test::tracedEverywhere(mesh);
    const double balanced = errorBy(Recipe::Balanced, mesh, truth);
    const double paper = errorBy(Recipe::Paper, mesh, truth);
    MESSAGE(name, ": balanced ", balanced, ", paper ", paper);
    CHECK(balanced < 0.8 * paper);
  }
}

TEST_CASE("quality is nearer to the function of many rays than balanced" * doctest::test_suite("slow")) {
  for (const std::string name : {"animal", "hand", "figure"}) {
    const Mesh mesh = generateShape(name, 4000).mesh;
    const std::vector<double> truth = test::tracedEverywhere(mesh, {.rayCount = 300, .rotation = ConeRotation::Hashed});
    const double quality = errorBy(Recipe::Quality, mesh, truth);
    const double balanced = errorBy(Recipe::Balanced, mesh, truth);
    MESSAGE(name, ": quality ", quality, ", balanced ", balanced);
    CHECK(quality < balanced);
  }
}

// Counted, not timed: a change that makes the solver slower fails here.
TEST_CASE("the equation needs no more iterations than stored") {
  for (const auto& stored : {std::pair("animal", 14u), std::pair("hand", 15u), std::pair("tree", 13u)}) {
    CAPTURE(std::string(stored.first));
    Options options;
    options.solver = SolverChoice::Cpu;
    const Mesh mesh = generateShape(stored.first, 20'000).mesh;
    const SolverReport report = referenceSession().compute(mesh, options).report.solver;
    CHECK(report.converged);
    CHECK(report.iterations <= stored.second);
  }
}
