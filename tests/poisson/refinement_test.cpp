#include <doctest/doctest.h>

#include <limits>

#include "fixtures.h"
#include "poisson/refinement.h"

using namespace asdfvk;

namespace {

// One unknown between constraints 2 and 4 at unit distance: 2 u = 6. The first guess 3 would be exact, so it is set
// to 1.
PoissonSystem oneUnknown() {
  PoissonSystem system = chain(3, 2, 4);
  system.constraintMean = 1;
  return system;
}

struct Passes {
  uint32_t count = 0;
  std::vector<double> reductions;

  /// Each pass takes 5 iterations and gives `share` of the exact correction.
  CorrectionSolver giving(double share) {
    return [this, share](const CorrectionRequest& request) {
      ++count;
      reductions.push_back(request.reduction);
      request.correction[0] = share * request.residual[0] / 2;
      return std::min(5u, request.maxIterations);
    };
  }
};

}  // namespace

TEST_CASE("passes follow until the true residual is within the tolerance") {
  Passes passes;
  std::vector<double> solution(1);
  // The first relative residual is 2/3 and each pass leaves a tenth: after the fourth it is below 1e-4.
  const SolverReport report =
      solveByRefinement(oneUnknown(), {.tolerance = 1e-4}, solution, {{1e-3, passes.giving(0.9)}});
  CHECK(passes.count == 4);
  CHECK(report.iterations == 20);
  CHECK(report.converged);
  CHECK(report.relativeResidual == doctest::Approx(2.0 / 3 * 1e-4).epsilon(1e-6));
  CHECK(solution[0] == doctest::Approx(3).epsilon(1e-3));
  // At least the smallest reduction, and a larger one where that is enough.
  CHECK(passes.reductions[0] == doctest::Approx(1e-3));
  CHECK(passes.reductions[3] == doctest::Approx(0.9 * 1e-4 / (2.0 / 3 * 1e-3)));
}

TEST_CASE("a pass that stagnates is the last") {
  Passes passes;
  std::vector<double> solution(1);
  const SolverReport report = solveByRefinement(oneUnknown(), {}, solution, {{1e-3, passes.giving(0.1)}});
  CHECK(passes.count == 1);
  CHECK_FALSE(report.converged);
  CHECK(report.relativeResidual == doctest::Approx(0.6));
}

TEST_CASE("after a pass that stagnates or increases the residual the next corrector is used") {
  for (double share : {0.1, 2.5, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(share);
    Passes poor, good;
    std::vector<double> solution(1);
    const SolverReport report =
        solveByRefinement(oneUnknown(), {}, solution, {{1e-3, poor.giving(share)}, {1e-5, good.giving(0.9)}});
    CHECK(poor.count == 1);
    CHECK(good.count == 4);
    CHECK(good.reductions[0] < 1e-3);
    CHECK(report.converged);
    CHECK(solution[0] == doctest::Approx(3).epsilon(1e-3));
  }
}

TEST_CASE("a correction that is not finite is discarded") {
  for (double share : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Passes passes;
    std::vector<double> solution(1);
    const SolverReport report = solveByRefinement(oneUnknown(), {}, solution, {{1e-3, passes.giving(share)}});
    CHECK(passes.count == 1);
    CHECK_FALSE(report.converged);
    CHECK(solution[0] == 1);
  }
}

TEST_CASE("a correction that increases the residual is discarded") {
  Passes passes;
  std::vector<double> solution(1);
  const SolverReport report = solveByRefinement(oneUnknown(), {}, solution, {{1e-3, passes.giving(2.5)}});
  CHECK(passes.count == 1);
  CHECK_FALSE(report.converged);
  CHECK(solution[0] == 1);
  CHECK(report.relativeResidual == doctest::Approx(2.0 / 3));
}

TEST_CASE("the iterations of all passes together do not exceed the maximum") {
  Passes passes;
  std::vector<double> solution(1);
  const SolverOptions options{.tolerance = 1e-12, .maxIterations = 12};
  const SolverReport report = solveByRefinement(oneUnknown(), options, solution, {{1e-3, passes.giving(0.9)}});
  CHECK(passes.count == 3);
  CHECK(report.iterations == 12);
  CHECK_FALSE(report.converged);
}

TEST_CASE("a first guess within the tolerance needs no pass") {
  Passes passes;
  std::vector<double> solution(1);
  const SolverReport report = solveByRefinement(chain(3, 2, 4), {}, solution, {{1e-3, passes.giving(0.9)}});
  CHECK(passes.count == 0);
  CHECK(report.converged);
  CHECK(solution[0] == 3);
}
