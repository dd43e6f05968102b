#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fixtures.h"
#include "poisson/poisson_solver.h"
#include "support/test_device.h"

namespace asdfvk {

struct SolverUnderTest {
  std::string name;
  std::unique_ptr<PoissonSolver> solver;
  double minTolerance;  ///< Smallest tolerance that it reaches on the equations of these tests.
  bool isDevice;
};

/// Every solver, those on the device under validation, if it has the storage buffers for them.
class SolversUnderTest {
 public:
  SolversUnderTest() {
    const std::map<std::string_view, double> minTolerances{{"eigen", 1e-12}, {"cpu", 1e-12}, {"cg", 1e-10}};
    const bool hasBuffers = test::hasBuffersForSolvers(*device_);
    for (const Solver& solver : solverTable()) {
      if (solver.needsDevice && !hasBuffers) continue;
      const auto found = minTolerances.find(nameOf(solver));
      solvers_.push_back({nameOf(solver), makeSolver(solver.choice, &*device_),
                          found == minTolerances.end() ? 1e-7 : found->second, solver.needsDevice});
    }
  }

  [[nodiscard]] auto begin() { return solvers_.begin(); }
  [[nodiscard]] auto end() { return solvers_.end(); }
  /// The order of the sums, which depends on the lanes of the device, decides whether float32 breaks down.
  [[nodiscard]] bool sumsAsTheCpu() const { return device_->facts().isCpu(); }

 private:
  test::ValidatedDevice device_;
  std::vector<SolverUnderTest> solvers_;
};

struct Solved {
  SolverReport report;
  std::vector<double> solution;
};

inline Solved solve(SolverUnderTest& under, const Equation& equation, const SolverOptions& options,
                    const RunControl& control = {}) {
  Solved solved;
  std::vector<double> values;
  solved.report =
      under.solver->onGraph(equation.graph, equation.weights)->solve(equation.problem(), options, values, control);
  for (const uint32_t face : equation.system.faces) solved.solution.push_back(values[face]);
  for (size_t face = 0; face < values.size(); ++face)
    if (std::isfinite(equation.constraints[face])) CHECK(values[face] == equation.constraints[face]);
  // A device that finishes in float32 measures its residual in float32, too.
  const double rounding = under.isDevice && !solved.report.finishedOnCpu ? 1e-6 : 0;
  const double residual = relativeResidual(equation.system, solved.solution);
  if (std::isfinite(residual)) CHECK(std::abs(solved.report.relativeResidual - residual) <= rounding + 1e-5 * residual);
  return solved;
}

inline Solved solveTightly(SolverUnderTest& under, const Equation& equation) {
  Solved solved = solve(under, equation, {.tolerance = under.minTolerance, .maxIterations = 200'000});
  CHECK(solved.report.converged);
  CHECK(solved.report.relativeResidual <= under.minTolerance);
  return solved;
}

}  // namespace asdfvk
