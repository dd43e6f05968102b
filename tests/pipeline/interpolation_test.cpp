#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "generate/shapes.h"
#include "mesh/dual_graph.h"
#include "pipeline/average_error.h"
#include "pipeline/vk/vulkan_backend.h"
#include "smooth/bilateral.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/test_device.h"

using namespace asdfvk;
using test::averageError;
using test::referenceSession;

namespace {

Result compute(const Mesh& mesh, const Options& options) { return referenceSession().compute(mesh, options); }

Options with(Guidance guidance) {
  Options options = test::tenthOfFaces();
  options.interpolation.guidance = guidance;
  return options;
}

}  // namespace

TEST_CASE("each sampler with each guidance gives every face of a closed mesh a value") {
  const Mesh mesh = makeHand(1200).mesh;
  for (const Guidance guidance : {Guidance::None, Guidance::Curvature, Guidance::Prediction})
    for (const auto& sampler : kSamplerNames) {
      CAPTURE(static_cast<int>(guidance));
      CAPTURE(sampler.first);
      Options options = with(guidance);
      options.sampler = sampler.second;
      const Result result = compute(mesh, options);
      CHECK(result.report.noValueCount == 0);
      CHECK(result.report.solver.converged);
      CHECK(result.report.seedCount == std::lround(0.1 * static_cast<double>(mesh.faces.size())));
      CHECK(result.report.estimatedError.has_value());
      const std::vector<double>& errors = test::expectedErrors(result);
      CHECK(std::all_of(errors.begin(), errors.end(), [](double e) { return e >= 0 && std::isfinite(e); }));
    }
}

TEST_CASE("seeds keep their traced values, bit for bit, unless values are pooled") {
  const Mesh mesh = makeAnimal(2000).mesh;
  const std::vector<double> traced = test::tracedEverywhere(mesh);
  for (const Guidance guidance : {Guidance::None, Guidance::Curvature, Guidance::Prediction}) {
    const Result result = compute(mesh, with(guidance));
    for (size_t face = 0; face < traced.size(); ++face)
      if (result.seed()[face]) CHECK(result.sdf()[face] == traced[face]);
  }
  Options pooled;
  pooled.interpolation.pooling = 0.5;
  const Result result = compute(mesh, pooled);
  size_t movedCount = 0;
  for (size_t face = 0; face < traced.size(); ++face)
    movedCount += result.seed()[face] && result.sdf()[face] != traced[face];
  CHECK(movedCount > result.report.seedCount / 2);
}

TEST_CASE("pooling moves values in proportion") {
  const Mesh mesh = makeTorus(1000).mesh;
  std::vector<double> at[3];
  for (int i = 0; i < 3; ++i) {
    Options options = test::tenthOfFaces();
    options.interpolation.pooling = 0.5 * i;
    at[i] = compute(mesh, options).sdf();
  }
  for (size_t face = 0; face < mesh.faces.size(); ++face)
    CHECK(at[1][face] == doctest::Approx(0.5 * (at[0][face] + at[2][face])).epsilon(1e-9));
}

TEST_CASE("smoothing is the last step, on the finished values") {
  const Mesh mesh = makeAnimal(2000).mesh;
  const DualGraph graph = buildDualGraph(mesh);
  const std::vector<double> rough = compute(mesh, test::tenthOfFaces()).sdf();
  Options options = test::tenthOfFaces();
  options.smoothing = {.isOn = true, .window = SmoothingOptions::Window{.rings = 2, .passes = 1}};
  const Result smooth = compute(mesh, options);
  CHECK(smooth.sdf() == smoothBilaterally(graph, rough, *options.smoothing.window));
  CHECK(smooth.sdf() != rough);
  options.smoothing.window.reset();
  CHECK(compute(mesh, options).sdf() == smoothBilaterally(graph, rough, smoothingWindowFor(mesh.faceCount())));
  options.smoothing.isOn = false;
  CHECK(compute(mesh, options).sdf() == rough);
}

TEST_CASE("guidance by prediction has a smaller error than none") {
  for (const std::string name : {"animal", "hand", "figure"}) {
    const Mesh mesh = generateShape(name, 4000).mesh;
    const std::vector<double> truth = test::tracedEverywhere(mesh);
    const double predicted = averageError(compute(mesh, with(Guidance::Prediction)).sdf(), truth);
    const double none = averageError(compute(mesh, with(Guidance::None)).sdf(), truth);
    MESSAGE(name, ": by prediction ", predicted, ", without ", none);
    CHECK(predicted < 0.9 * none);
  }
}

TEST_CASE("guidance by curvature changes the values") {
  const Mesh mesh = makeTorus(1000).mesh;
  CHECK(compute(mesh, with(Guidance::Curvature)).sdf() != compute(mesh, with(Guidance::None)).sdf());
}

TEST_CASE("values are within those of the seeds of their component, whatever the guidance and the solver") {
  const Mesh first = makeHand(1200).mesh, second = makeSphere(500, 20).mesh;
  const Mesh mesh = shapes::joined(first, second, {50, 0, 0});
  const auto checkWithin = [&](Session& session, SolverChoice solver, Guidance guidance) {
    CAPTURE(nameOf(kSolverNames, solver));
    CAPTURE(static_cast<int>(guidance));
    Options options = with(guidance);
    options.interpolation.weights = ArcWeights::Distance;
    options.sampler = SamplerChoice::Random;
    options.seeds = SeedCount::ofShare(0.02);
    options.solver = solver;
    const Result result = session.compute(mesh, options);
    size_t outsideCount = 0, limitedCount = 0;
    const std::pair<size_t, size_t> components[]{{0, first.faces.size()}, {first.faces.size(), mesh.faces.size()}};
    for (const auto& [begin, end] : components) {
      double low = std::numeric_limits<double>::max(), high = 0;
      for (size_t face = begin; face < end; ++face) {
        if (!result.seed()[face]) continue;
        low = std::min(low, result.sdf()[face]);
        high = std::max(high, result.sdf()[face]);
      }
      for (size_t face = begin; face < end; ++face) {
        const double value = result.sdf()[face];
        outsideCount += !(low <= value && value <= high);
        limitedCount += !result.seed()[face] && (value == low || value == high);
      }
    }
    CHECK(outsideCount == 0);
    CHECK(result.report.clampedCount == limitedCount);
    if (guidance == Guidance::Curvature) CHECK(limitedCount > 10);
  };
  const bool hasSolvers =
      test::hasBuffersForSolvers(*vulkanDeviceOf(*openBackend({.backend = BackendChoice::Vulkan}).backend));
  for (const Guidance guidance : {Guidance::None, Guidance::Curvature}) {
    for (const SolverChoice solver : {SolverChoice::Cpu, SolverChoice::Eigen})
      checkWithin(referenceSession(), solver, guidance);
    if (hasSolvers) checkWithin(test::vulkanSession(), SolverChoice::Cg, guidance);
  }
}

TEST_CASE("components without a seed of their own get one, whatever the guidance") {
  const Mesh mesh = shapes::joined(shapes::joined(makeTorus(2000).mesh, makeSphere(20).mesh, {5, 0, 0}),
                                   makeSphere(80).mesh, {0, 5, 0});
  for (const Guidance guidance : {Guidance::None, Guidance::Curvature, Guidance::Prediction}) {
    CAPTURE(static_cast<int>(guidance));
    Options options = with(guidance);
    options.seeds = SeedCount::ofCount(1);
    const Result result = compute(mesh, options);
    CHECK(result.report.componentCount == 3);
    CHECK(result.report.noValueCount == 0);
    CHECK(result.report.seedCount == 3);
    CHECK(std::count(result.seed().begin(), result.seed().end(), 1) == 3);
  }
}

TEST_CASE("values of an open mesh and of one with defects are finite or NaN, and errors are finite") {
  Mesh open = makeAnimal(2500).mesh;
  std::erase_if(open.faces, [&](const Face& face) { return open.vertices[face[0]].x > 0.3; });
  Mesh broken = makeAnimal(2500).mesh;
  const Face first = broken.faces[0];
  broken.faces.push_back({first[0], first[0], first[1]});                                   // degenerate
  broken.faces.push_back(broken.faces[10]);                                                 // twice
  broken.faces.push_back({broken.faces[20][1], broken.faces[20][0], broken.faces[20][2]});  // the other way round
  broken.vertices.push_back({std::nan(""), 0, 0});
  broken.faces.push_back({first[0], first[1], static_cast<uint32_t>(broken.vertices.size() - 1)});
  for (const Mesh& mesh : {open, broken})
    for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced, Recipe::Quality}) {
      CAPTURE(static_cast<int>(recipe));
      Options options = test::tenthOfFaces();
      applyRecipe(recipe, options);
      const Result result = compute(mesh, options);
      CHECK(result.sdf().size() == mesh.faces.size());
      CHECK(result.report.noValueCount < 10);
      CHECK(std::none_of(result.sdf().begin(), result.sdf().end(), [](double v) { return std::isinf(v); }));
      const std::vector<double>& errors = test::expectedErrors(result);
      CHECK(std::all_of(errors.begin(), errors.end(), [](double e) { return e >= 0 && std::isfinite(e); }));
      CHECK(result.report.solver.converged);
    }
}

TEST_CASE("options of the interpolation and of rounds out of range are errors of usage") {
  const auto requireFailure = [](const auto& change, ErrorCode code, const std::string& part) {
    Options options = test::tenthOfFaces();
    change(options);
    test::requireFailure([&] { (void)compute(makeSphere(80).mesh, options); }, code, part);
    CHECK(kindOf(code) == ErrorKind::Usage);
  };
  for (const double bad : {-0.1, 1.1, std::nan("")})
    requireFailure([&](Options& o) { o.interpolation.pooling = bad; }, ErrorCode::OptionOutOfRange, "pooling");
  requireFailure(
      [](Options& o) {
        o.interpolation.pooling = 0.5;
        o.interpolation.guidance = Guidance::None;
      },
      ErrorCode::OptionConflict, "pooling needs a prediction");
  requireFailure(
      [](Options& o) {
        o.estimatesError = false;
        o.rounds.maxRelativeError = 0.1;
      },
      ErrorCode::OptionConflict,
      "maxRelativeError needs the error estimate, which estimate=false excludes; drop one of the two");
  requireFailure(
      [&](Options& o) {
        o.seeds = SeedCount::all();
        o.rounds.maxError = 0.5;
      },
      ErrorCode::OptionConflict, "with seeds=all every face is a seed");
  requireFailure([](Options& o) { o.sampler = static_cast<SamplerChoice>(99); }, ErrorCode::UnknownName,
                 "sampler: '' is not one of random|blue-noise|farthest-point|normal-space|adaptive");
  requireFailure([](Options& o) { o.solver = static_cast<SolverChoice>(99); }, ErrorCode::UnknownName, "solver: ''");
  requireFailure(
      [](Options& o) { o.smoothing = {.isOn = true, .window = SmoothingOptions::Window{.rings = 5, .passes = 1}}; },
      ErrorCode::OptionOutOfRange, "");
  for (const double bad : {-1.0, 0.0, std::nan("")}) {
    requireFailure([&](Options& o) { o.rounds.maxError = bad; }, ErrorCode::OptionOutOfRange, "maxError: ");
    requireFailure([&](Options& o) { o.rounds.maxRelativeError = bad; }, ErrorCode::OptionOutOfRange,
                   "maxRelativeError: ");
  }
}

TEST_CASE("the device and the reference agree under every recipe") {
  const Mesh mesh = makeTorus(1500).mesh;
  for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced, Recipe::Quality}) {
    CAPTURE(static_cast<int>(recipe));
    Options options = test::tenthOfFaces();
    applyRecipe(recipe, options);
    options.solverOptions.tolerance = 1e-6;
    const Result device = test::vulkanSession().compute(mesh, options), reference = compute(mesh, options);
    CHECK(device.seed() == reference.seed());
    size_t differing = 0;
    for (size_t face = 0; face < mesh.faces.size(); ++face)
      differing += std::abs(device.sdf()[face] - reference.sdf()[face]) > 2e-3 * reference.sdf()[face];
    CHECK(differing <= mesh.faces.size() / 100);
  }
}

TEST_CASE("a part a hundred thousand times smaller than the other is interpolated as well") {
  constexpr double kSmaller = 1e-5;
  const Mesh animal = makeAnimal(2000).mesh;
  const size_t faceCount = animal.faces.size();
  Mesh smaller = animal;
  for (Vec3d& vertex : smaller.vertices) vertex = kSmaller * vertex;
  const Mesh mesh = shapes::joined(animal, smaller, {3, 0, 0});
  const std::vector<double> traced = test::tracedEverywhere(mesh);
  const auto small = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(faceCount), values.end());
  };
  const double greatest = *std::max_element(traced.begin() + static_cast<std::ptrdiff_t>(faceCount), traced.end());
  for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced}) {
    Options options = test::tenthOfFaces();
    applyRecipe(recipe, options);
    const std::vector<double> values = small(compute(mesh, options).sdf());
    CHECK(averageError(values, small(traced)) < 0.1);
    CHECK(*std::max_element(values.begin(), values.end()) < 1.5 * greatest);
  }
}
