#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "fixtures.h"
#include "poisson/poisson_solver.h"
#include "sample_problems.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/test_device.h"

using namespace asdfvk;

namespace {

/// A problem with all arrays that a GraphSolver needs.
struct GraphCase {
  std::vector<double> constraints, divergence, firstGuess;
  std::vector<uint32_t> componentOf;

  [[nodiscard]] GraphProblem problem() const { return {constraints, divergence, firstGuess, componentOf}; }
};

std::vector<uint32_t> searchComponents(const DualGraph& graph) {
  std::vector<uint32_t> componentOf(graph.faceCount(), UINT32_MAX);
  for (uint32_t face = 0, count = 0; face < graph.faceCount(); ++face) {
    if (componentOf[face] != UINT32_MAX) continue;
    std::vector<uint32_t> stack{face};
    componentOf[face] = count;
    while (!stack.empty()) {
      const uint32_t next = stack.back();
      stack.pop_back();
      for (const uint32_t neighbour : graph.neighboursOf(next))
        if (componentOf[neighbour] == UINT32_MAX) {
          componentOf[neighbour] = count;
          stack.push_back(neighbour);
        }
    }
    ++count;
  }
  return componentOf;
}

/// About one face in eight is constrained; some guesses and entries of the divergence are not finite.
GraphCase randomCase(const DualGraph& graph, std::vector<uint32_t> componentOf, uint64_t randomSeed,
                     bool hasDivergence) {
  Random random(randomSeed);
  GraphCase made;
  for (uint32_t face = 0; face < graph.faceCount(); ++face) {
    made.constraints.push_back(random.index(8) == 0 ? 1 + random.real() : kNoValue);
    made.firstGuess.push_back(random.index(5) == 0 ? kNoValue : 1 + random.real());
    if (hasDivergence) made.divergence.push_back(random.index(9) == 0 ? kNoValue : 0.1 * (random.real() - 0.5));
  }
  made.componentOf = std::move(componentOf);
  return made;
}

/// The values of all faces by conjugate gradients in double; NaN where there is none.
std::vector<double> valuesOnCpu(const DualGraph& graph, std::span<const double> weights, const GraphCase& given) {
  const PoissonSystem system = buildPoissonSystem(graph, weights, given.constraints, given.divergence,
                                                  {.firstGuess = given.firstGuess, .componentOf = given.componentOf});
  std::vector<double> solution(system.unknownCount()), values = given.constraints;
  makeEigenSolver(nullptr)->solve(system, {.tolerance = 1e-12, .maxIterations = 10'000}, solution, {});
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
  for (const std::string name : {"cg", "jacobi"}) {
    CAPTURE(name);
    const std::unique_ptr<PoissonSolver> solver = makeSolver(name, &*device);
    const SolverOptions options{.tolerance = name == "cg" ? 1e-10 : 1e-7, .maxIterations = 100'000};
    forEachSetting([&](const Setting& setting) {
      // Where weights differ by many decades, Jacobi iterations do not converge in any practical number.
      if (name == "jacobi" && (!setting.problem.isManifold || setting.kind != ArcWeights::Distance)) return;
      const DualGraph& graph = setting.problem.graph;
      const std::vector<uint32_t> componentOf = searchComponents(graph);
      const std::unique_ptr<GraphSolver> onGraph = solver->onGraph(graph, setting.weights);
      REQUIRE(onGraph != nullptr);
      for (const bool hasDivergence : {false, true})
        for (const uint64_t randomSeed : {1u, 2u, 1u}) {
          const GraphCase given = randomCase(graph, componentOf, randomSeed, hasDivergence);
          std::vector<double> values = given.constraints;
          const SolverReport report = onGraph->solve(given.problem(), options, values, {});
          CHECK(report.converged);
          CHECK(report.relativeResidual <= options.tolerance);
          const PoissonSystem system =
              buildPoissonSystem(graph, setting.weights, given.constraints, given.divergence, {});
          std::vector<double> solution;
          for (const uint32_t face : system.faces) solution.push_back(values[face]);
          CHECK(relativeResidual(system, solution) <= 1.01 * options.tolerance);
          // Weights of its coincident faces are a billion times larger than others: residuals do not bound errors.
          if (setting.kind != ArcWeights::Distance || setting.problem.name != "dense random faces")
            checkValues(values, valuesOnCpu(graph, setting.weights, given), 1e-3);
          std::vector<double> again = given.constraints;
          CHECK(onGraph->solve(given.problem(), options, again, {}).iterations == report.iterations);
          CHECK(test::haveSameBits(again, values));
        }
    });
  }
}

TEST_CASE("a solver on a graph finishes on the CPU where float32 does not reach the tolerance") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const SampleProblem sample("torus", torus(40, 20));
  const std::vector<double> weights = arcWeights(ArcWeights::Distance, sample.graph, sample.geometry);
  const GraphCase given = randomCase(sample.graph, searchComponents(sample.graph), 3, true);
  const std::unique_ptr<PoissonSolver> solver = makeSolver("cg", &*device);
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

TEST_CASE("on a graph, too, constraints of 0 give 0, and faces without a path to a constraint keep their values") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}, {6, 0, 0}, {9, 9, 9}}, {{0, 1}, {1, 2}, {3, 4}});
  const std::vector<double> weights = arcWeights(ArcWeights::Distance, hand.graph, hand.geometry);
  const std::unique_ptr<PoissonSolver> solver = makeSolver("cg", &*device);
  const std::unique_ptr<GraphSolver> onGraph = solver->onGraph(hand.graph, weights);
  GraphCase given{{0, kNoValue, 0, kNoValue, kNoValue, kNoValue}, {}, std::vector<double>(6, 4.0), {0, 0, 0, 1, 1, 2}};
  std::vector<double> values(6, 8.0);
  CHECK(onGraph->solve(given.problem(), {}, values, {}).converged);
  CHECK(values == std::vector<double>{8, 0, 8, 8, 8, 8});
  given.constraints[2] = 2;
  CHECK(onGraph->solve(given.problem(), {}, values, {}).converged);
  CHECK(values[1] == doctest::Approx(1));
  given.constraints.assign(6, kNoValue);
  values.assign(6, 8.0);
  CHECK(onGraph->solve(given.problem(), {}, values, {}).converged);
  CHECK(values == std::vector<double>(6, 8.0));
}

TEST_CASE("the residual of a graph's equation is that of its system, and its norms are too") {
  forEachSetting([](const Setting& setting) {
    const DualGraph& graph = setting.problem.graph;
    const GraphCase given = randomCase(graph, searchComponents(graph), 7, true);
    const PoissonSystem whole = wholePoissonSystem(graph, setting.weights);
    const GraphEquation equation(graph, setting.weights, whole.diagonal, given.problem());
    const PoissonSystem system = buildPoissonSystem(graph, setting.weights, given.constraints, given.divergence,
                                                    {.firstGuess = given.firstGuess, .componentOf = given.componentOf});
    std::vector<double> values(graph.faceCount()), residual(values.size()), expected(system.unknownCount());
    setFirstGuess(equation, values);
    computeResidual(equation, values, residual);
    computeResidual(system, system.firstGuess, expected);
    uint32_t unknownCount = 0;
    for (uint32_t face = 0; face < values.size(); ++face) {
      if (!equation.isUnknown(face)) {
        CHECK(residual[face] == 0);
        CHECK(values[face] == (std::isnan(given.constraints[face]) ? 0 : given.constraints[face]));
        continue;
      }
      REQUIRE(unknownCount < system.unknownCount());
      CHECK(system.faces[unknownCount] == face);
      CHECK(whole.diagonal[face] == system.diagonal[unknownCount]);
      CHECK(values[face] == system.firstGuess[unknownCount]);
      CHECK(std::abs(residual[face] - expected[unknownCount]) <= 1e-14 * (whole.diagonal[face] + 0.1));
      ++unknownCount;
    }
    CHECK(unknownCount == system.unknownCount());
    CHECK(residualNorm(equation, residual) == doctest::Approx(residualNorm(system, expected)).epsilon(1e-9));
    CHECK(rightHandNorm(equation) == doctest::Approx(rightHandNorm(system)).epsilon(1e-9));
  });
}

TEST_CASE("a whole system has a positive diagonal, also for faces without neighbours") {
  const HandGraph hand({{0, 0, 0}, {2, 0, 0}, {9, 9, 9}}, {{0, 1}});
  const std::vector<double> weights = arcWeights(ArcWeights::Distance, hand.graph, hand.geometry);
  const PoissonSystem whole = wholePoissonSystem(hand.graph, weights);
  CHECK(std::vector(whole.diagonal.begin(), whole.diagonal.end()) == std::vector<double>(3, 0.5));
  const HandGraph alone({{0, 0, 0}}, {});
  CHECK(wholePoissonSystem(alone.graph, {}).diagonal[0] == 1);
}

TEST_CASE("solvers of the CPU keep nothing of a graph") {
  const SampleProblem sample("torus", torus(14, 10));
  const std::vector<double> weights = arcWeights(ArcWeights::Distance, sample.graph, sample.geometry);
  for (const Solver& solver : solverTable())
    if (!solver.needsDevice) CHECK(makeSolver(solver.name, nullptr)->onGraph(sample.graph, weights) == nullptr);
}

TEST_CASE("a graph beyond a limit of the device is refused") {
  const Instance instance({.validation = true});
  DeviceFacts facts = describeDevice(instance.physicalDevices().front());
  if (facts.maxStorageBuffersPerStage < 8) return;
  facts.maxStorageBufferRange = 1000;
  const Device device(instance.physicalDevices().front(), facts);
  const SampleProblem sample("torus", torus(40, 20));
  const std::vector<double> weights = arcWeights(ArcWeights::Distance, sample.graph, sample.geometry);
  const std::unique_ptr<PoissonSolver> solver = makeSolver("cg", &device);
  test::requireFailure([&] { (void)solver->onGraph(sample.graph, weights); }, ErrorCode::EquationLimit,
                       "1600 unknowns");
}
