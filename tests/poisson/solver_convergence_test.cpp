// Convergence, cancellation and reproducibility of the solvers, and the change from float32 to double.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "dense_twin.h"
#include "poisson/cpu_cg.h"
#include "sample_problems.h"
#include "solvers_under_test.h"

using namespace asdfvk;

namespace {

/// A chain of 40 faces whose weights span ten decades: float32 conjugate gradients break down on it.
Equation unevenChain() {
  constexpr uint32_t kFaceCount = 40;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  std::vector<double> weights;  // In the order of the arcs: each face's arc to the face before it comes first.
  Random random(3);
  for (uint32_t face = 1; face < kFaceCount; ++face) {
    edges.emplace_back(face - 1, face);
    weights.insert(weights.end(), 2, std::pow(10.0, 10 * random.real()));
  }
  const HandGraph hand(std::vector<Vec3d>(kFaceCount), edges);
  std::vector<double> values(kFaceCount, kNoValue);
  values.front() = 1;
  values.back() = 3;
  return {hand.graph, weights, values};
}

}  // namespace

TEST_CASE("not converging is reported, not thrown") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, equation, {.tolerance = 1e-6, .maxIterations = 1});
    CHECK_FALSE(report.converged);
    CHECK(report.iterations == 1);
    CHECK(report.relativeResidual > 1e-6);
    CHECK(solve(under, equation, {.tolerance = 1e-6, .maxIterations = 0}).report.iterations == 0);
  }
}

TEST_CASE("a tolerance of 0 ends with a small residual") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(10, 10);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, equation, {.tolerance = 0, .maxIterations = 5000});
    CHECK(report.relativeResidual < 1e-6);
  }
}

TEST_CASE("a right-hand side that overflows is reported as not converged, or solved in the unit of a device") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<double> values{1e308, kNoValue, kNoValue, 1}, divergence{0, 1e308, 0, 0};
  const Equation equation = distanceEquation(hand.graph, hand.geometry, values, divergence);
  REQUIRE(std::isinf(equation.system.rightHandSide[0]));
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const Solved solved = solve(under, equation, {});
    CHECK(solved.report.converged == under.isDevice);
    if (under.isDevice) CHECK(solved.solution[0] == doctest::Approx(4.0 / 3 * 1e308).epsilon(1e-3));
  }
}

TEST_CASE("a solver stops on request") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    std::stop_source source;
    int calls = 0;
    double last = 0;
    const RunControl control{source.get_token(), [&](double fraction) {
                               CHECK(fraction >= last);
                               CHECK(fraction <= 1);
                               last = fraction;
                               if (++calls == 2) source.request_stop();
                             }};
    bool cancelled = false;
    try {
      (void)solve(under, equation, {.tolerance = under.minTolerance}, control);
    } catch (const Error& error) {
      cancelled = error.kind() == ErrorKind::Cancelled;
    }
    CHECK(cancelled);
    CHECK(calls == 2);
    // The solver remains usable.
    CHECK(solve(under, equation, {}).report.converged);
  }
}

TEST_CASE("two runs give the same bits") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30), other = torusEquation(20, 10);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const Solved first = solve(under, equation, {});
    (void)solve(under, other, {});
    const Solved second = solve(under, equation, {});
    CHECK(first.report.iterations == second.report.iterations);
    CHECK(std::memcmp(first.solution.data(), second.solution.data(), first.solution.size() * sizeof(double)) == 0);
  }
}

TEST_CASE("solvers on the CPU give the same bits on any number of threads") {
  const Equation equation = torusEquation(160, 80);
  for (const Solver& solver : solverTable()) {
    if (solver.needsDevice) continue;
    std::vector<double> solutions[3];
    for (const size_t threadCount : {1, 2, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
      std::vector<double>& solution = solutions[threadCount - 1];
      const std::unique_ptr<PoissonSolver> made = makeSolver(solver.choice, nullptr);
      const std::unique_ptr<GraphSolver> onGraph = made->onGraph(equation.graph, equation.weights);
      CHECK(onGraph->solve(equation.problem(), {}, solution, {}).converged);
    }
    for (size_t i : {1, 2})
      CHECK(std::memcmp(solutions[0].data(), solutions[i].data(), solutions[0].size() * sizeof(double)) == 0);
  }
}

TEST_CASE("where float32 breaks down, on the CPU or on a device, double continues") {
  const Equation equation = unevenChain();
  const PoissonSystem& system = equation.system;
  const ScaledSystem scaled(system);
  std::vector<double> start(system.unknownCount(), system.constraintMean), residual(start.size());
  computeResidual(system, start, residual);
  CpuCg cg(scaled, scaled.scaleResidual(residual, residualNorm(system, residual)), 1e-6);
  REQUIRE(cg.advance(20'000).status == kCgBrokenDown);
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    if (under.name == "jacobi") continue;  // It needs too many iterations until it stagnates.
    CAPTURE(under.name);
    const SolverReport report = solve(under, equation, {.tolerance = 1e-6}).report;
    CHECK(report.converged);
    CHECK(report.relativeResidual <= 1e-6);
    if (under.name != "cg") CHECK_FALSE(report.finishedOnCpu);
    if (under.name == "cg" && solvers.sumsAsTheCpu()) CHECK(report.finishedOnCpu);
    CHECK_FALSE(solve(under, torusEquation(20, 10), {.tolerance = 1e-6}).report.finishedOnCpu);
  }
}

TEST_CASE("the iterations of the CPU count towards the maximum") {
  const Equation equation = unevenChain();
  SolversUnderTest solvers;
  const auto cg = std::find_if(solvers.begin(), solvers.end(), [](const auto& under) { return under.name == "cg"; });
  if (cg == solvers.end()) return;
  const uint32_t whole = solve(*cg, equation, {.tolerance = 1e-6}).report.iterations;
  const SolverReport report = solve(*cg, equation, {.tolerance = 1e-6, .maxIterations = whole - 1}).report;
  CHECK_FALSE(report.converged);
  CHECK(report.iterations == whole - 1);
  if (solvers.sumsAsTheCpu()) CHECK(report.finishedOnCpu);
}

TEST_CASE("with coincident faces float32 may not converge, but the residual does not grow") {
  SolversUnderTest solvers;
  for (uint64_t seed : {2, 3, 4}) {
    const SampleProblem problem("coincident faces", randomFaces(25, 300, seed));
    const Equation equation = distanceEquation(problem.graph, problem.geometry, problem.values);
    for (SolverUnderTest& under : solvers) {
      CAPTURE(under.name);
      const Solved solved = solve(under, equation, {.tolerance = 1e-6});
      CHECK(solved.report.relativeResidual <=
            relativeResidual(equation.system,
                             std::vector<double>(equation.system.unknownCount(), equation.system.constraintMean)));
      CHECK(*std::min_element(solved.solution.begin(), solved.solution.end()) > 0);
      CHECK(*std::max_element(solved.solution.begin(), solved.solution.end()) < 3);
    }
  }
}

TEST_CASE("a solver starts from the first guess") {
  SolversUnderTest solvers;
  const SampleProblem problem("torus", torus(14, 10));
  const UnsetVector<double> weights = featureWeights(arcAngles(problem.graph, problem.geometry));
  const DenseTwin twin(problem.graph, weights, problem.values, {});
  std::vector<double> guess(problem.values.size(), 1.25);
  const auto build = [&] { return Equation(problem.graph, weights, problem.values, {}, guess); };
  const Equation away = build();
  for (size_t i = 0; i < twin.faces.size(); ++i)
    guess[static_cast<size_t>(twin.faces[i])] = twin.solution[static_cast<Eigen::Index>(i)];
  const Equation there = build();
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solve(under, away, {.tolerance = 1e-6, .maxIterations = 0}).solution ==
          std::vector<double>(away.system.unknownCount(), 1.25));
    const Solved solved = solve(under, there, {.tolerance = 1e-10});
    CHECK(solved.report.converged);
    CHECK(solved.report.iterations == 0);
    CHECK(solved.solution == there.system.firstGuess);
  }
}
