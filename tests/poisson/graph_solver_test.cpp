#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "fixtures.h"
#include "poisson/poisson_solver.h"
#include "poisson/vk/vulkan_cg.h"
#include "poisson/vk/vulkan_equation.h"
#include "sample_problems.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/test_device.h"

using namespace asdfvk;

namespace {

/// A problem with all arrays that a GraphSolver needs.
struct GraphCase {
  std::vector<double> constraints, firstGuess, guide, divergence;
  std::vector<uint32_t> componentOf;

  [[nodiscard]] GraphProblem problem() const { return {constraints, firstGuess, guide, divergence, componentOf}; }

  /// That of the guide included.
  [[nodiscard]] std::vector<double> wholeDivergence(const DualGraph& graph, std::span<const double> weights) const {
    std::vector<double> whole(graph.faceCount(), 0.0);
    if (!guide.empty()) whole = divergenceOf(graph, weights, guide);
    for (size_t face = 0; face < divergence.size(); ++face)
      if (std::isfinite(divergence[face])) whole[face] += divergence[face];
    return whole;
  }
  /// Where a device begins.
  [[nodiscard]] std::vector<double> start() const {
    std::vector<double> start = firstGuess;
    for (size_t face = 0; face < guide.size(); ++face)
      if (std::isfinite(guide[face])) start[face] = guide[face];
    return start;
  }
  [[nodiscard]] PoissonSystem system(const DualGraph& graph, std::span<const double> weights) const {
    const std::vector<double> begin = start();
    return buildPoissonSystem(graph, weights, constraints, wholeDivergence(graph, weights), componentOf, begin);
  }
};

struct Divergence {
  bool ofGuide, further;
};
constexpr Divergence kDivergences[] = {{false, false}, {false, true}, {true, false}, {true, true}};

/// About one face in eight is constrained; some guesses, and some entries of the guide and of the divergence, are not
/// finite.
GraphCase randomCase(const DualGraph& graph, std::vector<uint32_t> componentOf, uint64_t randomSeed,
                     const Divergence& has) {
  Random random(randomSeed);
  GraphCase made;
  for (uint32_t face = 0; face < graph.faceCount(); ++face) {
    made.constraints.push_back(random.index(8) == 0 ? 1 + random.real() : kNoValue);
    made.firstGuess.push_back(random.index(5) == 0 ? kNoValue : 1 + random.real());
    if (has.ofGuide) made.guide.push_back(random.index(6) == 0 ? kNoValue : 1 + random.real());
    if (has.further) made.divergence.push_back(random.index(9) == 0 ? kNoValue : 0.1 * (random.real() - 0.5));
  }
  made.componentOf = std::move(componentOf);
  return made;
}

/// The values of all faces by conjugate gradients in double; NaN where there is none.
std::vector<double> valuesOnCpu(const DualGraph& graph, std::span<const double> weights, const GraphCase& given) {
  const PoissonSystem system = given.system(graph, weights);
  std::vector<double> solution(system.unknownCount()), values = given.constraints;
  (void)solveByEigen(system, {.tolerance = 1e-12, .maxIterations = 10'000}, solution, {});
  for (size_t i = 0; i < solution.size(); ++i) values[system.faces[i]] = solution[i];
  return values;
}

void checkValues(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  REQUIRE(values.size() == expected.size());
  double worst = 0;
  size_t missingCount = 0;
  for (size_t face = 0; face < values.size(); ++face) {
    missingCount += std::isnan(values[face]) != std::isnan(expected[face]);
    if (!std::isnan(expected[face])) worst = std::max(worst, std::abs(values[face] - expected[face]));
  }
  CHECK(missingCount == 0);
  CHECK(worst < tolerance);
}

}  // namespace

TEST_CASE("solvers of a device have the solution of the CPU on one matrix for different constraints") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  for (const SolverChoice choice : {SolverChoice::Cg, SolverChoice::Jacobi}) {
    CAPTURE(nameOf(kSolverNames, choice));
    const std::unique_ptr<PoissonSolver> solver = makeSolver(choice, &*device);
    forEachSetting([&](const Setting& setting) {
      // Where weights differ by many decades, Jacobi iterations do not converge in any practical number.
      if (choice == SolverChoice::Jacobi && (!setting.problem.isManifold || setting.kind != ArcWeights::Distance))
        return;
      const DualGraph& graph = setting.problem.graph;
      const std::vector<uint32_t> componentOf = searchComponents(graph);
      const std::unique_ptr<GraphSolver> onGraph = solver->onGraph(graph, setting.weights);
      for (const Divergence& divergence : kDivergences) {
        std::map<uint64_t, std::pair<uint32_t, std::vector<double>>> firstOf;  // By random seed: iterations, values.
        for (const uint64_t randomSeed : {1u, 1u, 2u, 2u, 1u}) {
          const GraphCase given = randomCase(graph, componentOf, randomSeed, divergence);
          // Below kMinDeviceTolerance the CPU finishes.
          const double precise = choice == SolverChoice::Cg ? 1e-10 : 1e-7;
          const SolverOptions options{.tolerance = randomSeed == 2 ? precise : 2e-6, .maxIterations = 100'000};
          std::vector<double> values;
          const SolverReport report = onGraph->solve(given.problem(), options, values, {});
          CHECK(report.converged);
          CHECK(report.relativeResidual <= options.tolerance);
          const PoissonSystem system = given.system(graph, setting.weights);
          std::vector<double> solution;
          for (const uint32_t face : system.faces) solution.push_back(values[face]);
          CHECK(relativeResidual(system, solution) <= 1.01 * options.tolerance);
          // Weights of its coincident faces are a billion times larger than others: residuals do not bound errors. Nor
          // do those of the looser tolerance where weights differ by decades.
          const bool isBillion = setting.kind == ArcWeights::Distance && setting.problem.name == "dense random faces";
          if (setting.problem.isManifold || (options.tolerance == precise && !isBillion))
            checkValues(values, valuesOnCpu(graph, setting.weights, given), 1e-3);
          // Again, and again after another case, with the same bits.
          const auto& [iterations, first] = firstOf.try_emplace(randomSeed, report.iterations, values).first->second;
          CHECK(report.iterations == iterations);
          CHECK(test::haveSameBits(values, first));
        }
      }
    });
  }
}

TEST_CASE("a solver on a graph finishes on the CPU where float32 does not reach the tolerance") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const SampleProblem sample("torus", torus(40, 20));
  const UnsetVector<double> weights = distanceWeights(sample.graph, sample.geometry);
  const GraphCase given = randomCase(sample.graph, searchComponents(sample.graph), 3, {true, true});
  const std::unique_ptr<PoissonSolver> solver = makeSolver(SolverChoice::Cg, &*device);
  const std::unique_ptr<GraphSolver> onGraph = solver->onGraph(sample.graph, weights);
  std::vector<double> values = given.constraints;
  const SolverReport unreachable =
      onGraph->solve(given.problem(), {.tolerance = 1e-30, .maxIterations = 5000}, values, {});
  CHECK(unreachable.finishedOnCpu);
  CHECK_FALSE(unreachable.converged);
  CHECK(unreachable.relativeResidual < 1e-14);
  checkValues(values, valuesOnCpu(sample.graph, weights, given), 1e-10);
  const SolverReport few = onGraph->solve(given.problem(), {.tolerance = 1e-30, .maxIterations = 4}, values, {});
  CHECK(few.iterations == 4);
  CHECK_FALSE(few.finishedOnCpu);
}

TEST_CASE("on a device, too, constraints of 0 give 0, and faces without a path to a constraint have no value") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}, {6, 0, 0}, {9, 9, 9}}, {{0, 1}, {1, 2}, {3, 4}});
  const UnsetVector<double> weights = distanceWeights(hand.graph, hand.geometry);
  const std::unique_ptr<PoissonSolver> solver = makeSolver(SolverChoice::Cg, &*device);
  const std::unique_ptr<GraphSolver> onGraph = solver->onGraph(hand.graph, weights);
  GraphCase given{.constraints = {0, kNoValue, 0, kNoValue, kNoValue, kNoValue},
                  .firstGuess = std::vector<double>(6, 4.0),
                  .componentOf = {0, 0, 0, 1, 1, 2}};
  std::vector<double> values(6, 8.0);
  CHECK(onGraph->solve(given.problem(), {}, values, {}).converged);
  const double none = kNoValue;
  CHECK(test::haveSameBits(values, {0, 0, 0, none, none, none}));
  given.constraints[2] = 2;
  CHECK(onGraph->solve(given.problem(), {}, values, {}).converged);
  CHECK(values[1] == doctest::Approx(1));
  given.constraints.assign(6, kNoValue);
  CHECK(onGraph->solve(given.problem(), {}, values, {}).converged);
  CHECK(test::haveSameBits(values, given.constraints));
}

TEST_CASE("right-hand side and residual that a device makes are those of the system") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const VulkanEquationKernels kernels(*device);
  forEachSetting([&](const Setting& setting) {
    const DualGraph& graph = setting.problem.graph;
    const VulkanGraph onDevice(*device, kernels, graph, setting.weights);
    for (const Divergence& divergence : kDivergences) {
      const GraphCase given = randomCase(graph, searchComponents(graph), 7, divergence);
      const PoissonSystem system = given.system(graph, setting.weights);
      const GraphProblem problem = given.problem();
      VulkanEquation equation(*device, kernels, onDevice, problem);
      // The norms of the device are in its unit of the values; the ratio has none.
      std::vector<double> residual(system.unknownCount());
      computeResidual(system, system.firstGuess, residual);
      const double norm = residualNorm(system, residual);
      CHECK(equation.residualNorm() / equation.rightHandNorm() ==
            doctest::Approx(norm / rightHandNorm(system)).epsilon(1e-5));
      const double unit = norm / equation.residualNorm();
      const std::vector<float> weights = equation.residualWeights();
      std::vector<float> scaled(graph.faceCount());
      downloadBuffer(*device, equation.scaledResidual(), std::as_writable_bytes(std::span(scaled)));
      uint32_t unknownCount = 0;
      double worst = 0, worstWeight = 0;
      for (uint32_t face = 0; face < scaled.size(); ++face) {
        const bool isUnknown = unknownCount < system.unknownCount() && system.faces[unknownCount] == face;
        CHECK((weights[face] > 0) == isUnknown);
        if (!isUnknown) {
          CHECK(scaled[face] == 0);
          continue;
        }
        const double diagonal = system.diagonal[unknownCount] * onDevice.weightScale;
        worstWeight = std::max(worstWeight, std::abs(static_cast<double>(weights[face]) * diagonal - 1));
        // b = D^-1/2 r / norm, so that D^-1 r = norm b / D^1/2.
        const double error = static_cast<double>(scaled[face]) * equation.residualNorm() / std::sqrt(diagonal);
        const double expected = residual[unknownCount] / system.diagonal[unknownCount];
        worst = std::max(worst, std::abs(error * unit - expected) / (1 + std::abs(expected)));
        ++unknownCount;
      }
      CHECK(unknownCount == system.unknownCount());
      CHECK(worstWeight < 1e-5);
      CHECK(worst < 2e-6);
    }
  });
}

TEST_CASE("a device makes the rows of a graph, and of any arcs, as the system has them") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const VulkanEquationKernels kernels(*device);
  const VulkanCgKernels cgKernels(*device);
  forEachSetting([&](const Setting& setting) {
    const DualGraph& graph = setting.problem.graph;
    const std::vector<uint32_t> componentOf(graph.faceCount(), 0);
    // Every face but the first is unknown, also those without a path to it: one row of S per face.
    GraphCase given{.constraints = std::vector<double>(graph.faceCount(), kNoValue),
                    .firstGuess = std::vector<double>(graph.faceCount(), 1.0),
                    .componentOf = componentOf};
    given.constraints[0] = 2;
    const VulkanGraph onDevice(*device, kernels, graph, setting.weights);
    const GraphProblem problem = given.problem();
    const VulkanEquation equation(*device, kernels, onDevice, problem);
    const std::vector<float> weights = equation.residualWeights();
    Random random(3);
    std::vector<float> direction;
    for (uint32_t face = 0; face < graph.faceCount(); ++face)
      direction.push_back(weights[face] > 0 ? static_cast<float>(random.real()) : 0);
    const Buffer start = uploadVector(*device, direction, kPoissonVectorUsage);
    VulkanCg cg(*device, cgKernels, onDevice.matrix, start, 0);
    (void)cg.advance(1);
    const std::vector<float> product = cg.product();
    const auto diagonalOf = [&](uint32_t face) {
      double sum = 0;
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc)
        if (graph.neighbours[arc] != face) sum += setting.weights[arc];
      return sum;
    };
    double worst = 0;
    for (uint32_t face = 0; face < graph.faceCount(); ++face) {
      if (!(weights[face] > 0)) continue;
      double expected = static_cast<double>(direction[face]);
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc)
        if (const uint32_t neighbour = graph.neighbours[arc]; neighbour != face)
          expected -= setting.weights[arc] / std::sqrt(diagonalOf(face)) / std::sqrt(diagonalOf(neighbour)) *
                      static_cast<double>(direction[neighbour]);
      worst = std::max(worst, std::abs(static_cast<double>(product[face]) - expected));
    }
    CHECK(worst < 2e-6);
  });
}

TEST_CASE("the relative result of a solver on a graph does not depend on the units of values and weights") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const SampleProblem sample("torus", torus(40, 20));
  const UnsetVector<double> weights = distanceWeights(sample.graph, sample.geometry);
  const GraphCase given = randomCase(sample.graph, searchComponents(sample.graph), 3, {true, false});
  const std::unique_ptr<PoissonSolver> solver = makeSolver(SolverChoice::Cg, &*device);
  const std::vector<double> expected = valuesOnCpu(sample.graph, weights, given);
  for (const double unitOfValues : {1e-310, 1e-290, 1e-12, 1.0, 1e290})
    for (const double unitOfWeights : {1e-290, 1.0, 1e290}) {
      CAPTURE(unitOfValues);
      CAPTURE(unitOfWeights);
      GraphCase scaled = given;
      for (std::vector<double>* const array : {&scaled.constraints, &scaled.firstGuess, &scaled.guide})
        for (double& value : *array) value *= unitOfValues;
      UnsetVector<double> scaledWeights = weights;
      for (double& weight : scaledWeights) weight *= unitOfWeights;
      const std::unique_ptr<GraphSolver> onGraph = solver->onGraph(sample.graph, scaledWeights);
      std::vector<double> values = scaled.constraints;
      const SolverReport report = onGraph->solve(scaled.problem(), {}, values, {});
      if (unitOfValues * unitOfWeights < 1e-300 || unitOfValues * unitOfWeights > 1e300) continue;
      CHECK(report.converged);
      for (double& value : values) value /= unitOfValues;
      if (unitOfValues > 1e-300) checkValues(values, expected, 1e-2);
    }
}

TEST_CASE("a component of small values is solved beside one of large values") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 0, 0}, {10, 0, 0}, {11, 0, 0}},
                       {{0, 1}, {1, 2}, {3, 4}, {4, 5}});
  const UnsetVector<double> weights = distanceWeights(hand.graph, hand.geometry);
  const GraphCase given{.constraints = {1, kNoValue, 3, 0.001, kNoValue, 0.003},
                        .firstGuess = {2, 2, 2, 0.002, 0.0021, 0.002},
                        .guide = {1, 2, 3, kNoValue, kNoValue, kNoValue},
                        .componentOf = {0, 0, 0, 1, 1, 1}};
  const std::unique_ptr<PoissonSolver> solver = makeSolver(SolverChoice::Cg, &*device);
  std::vector<double> values = given.constraints;
  CHECK(solver->onGraph(hand.graph, weights)->solve(given.problem(), {.tolerance = 1e-6}, values, {}).converged);
  CHECK(values[1] == doctest::Approx(2));
  CHECK(values[4] == doctest::Approx(0.002).epsilon(1e-3));
}

TEST_CASE("a graph beyond a limit of the device is refused") {
  const Instance instance({.validation = true});
  DeviceFacts facts = describeDevice(instance.physicalDevices().front());
  if (facts.maxStorageBuffersPerStage < 8) return;
  facts.maxStorageBufferRange = 1000;
  const Device device(instance.physicalDevices().front(), facts);
  const SampleProblem sample("torus", torus(40, 20));
  const UnsetVector<double> weights = distanceWeights(sample.graph, sample.geometry);
  const std::unique_ptr<PoissonSolver> solver = makeSolver(SolverChoice::Cg, &device);
  test::requireFailure([&] { (void)solver->onGraph(sample.graph, weights); }, ErrorCode::EquationLimit,
                       "1600 unknowns");
}
