#include "poisson/refinement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"

namespace asdfvk {
namespace {

// Asked of a pass beyond what is needed, so that rounding in its own residual does not cost another pass.
constexpr double kSafety = 0.9;
// A pass that leaves more than this share of the residual has met the limit of its precision.
constexpr double kStagnation = 0.5;

}  // namespace

SolverReport solveByRefinement(const std::string& name, const PoissonSystem& system, const SolverOptions& options,
                               double strongestReduction, std::span<double> solution, const CorrectionSolver& correct) {
  ASDFVK_CHECK_OP(solution.size(), ==, system.faces.size());
  SolverReport report;
  report.name = name;
  if (system.firstGuess.empty())
    std::fill(solution.begin(), solution.end(), system.knownMean);
  else
    std::copy(system.firstGuess.begin(), system.firstGuess.end(), solution.begin());
  const double rightHandNorm = residualNorm(system, system.rightHandSide);
  if (rightHandNorm == 0) {
    std::fill(solution.begin(), solution.end(), 0.0);
    return report;
  }
  const double target = options.tolerance * rightHandNorm;
  std::vector<double> residual(solution.size()), correction(solution.size());
  computeResidual(system, solution, residual);
  double norm = residualNorm(system, residual);
  while (norm > target && report.iterations < options.maxIterations) {
    report.iterations += correct({.residual = residual,
                                  .reduction = std::max(kSafety * target / norm, strongestReduction),
                                  .maxIterations = options.maxIterations - report.iterations,
                                  .correction = correction});
    if (!std::all_of(correction.begin(), correction.end(), [](double e) { return std::isfinite(e); })) break;
    for (size_t i = 0; i < solution.size(); ++i) correction[i] += solution[i];
    computeResidual(system, correction, residual);
    const double newNorm = residualNorm(system, residual);
    if (!(newNorm <= norm)) break;
    std::copy(correction.begin(), correction.end(), solution.begin());
    const bool stagnates = newNorm > kStagnation * norm;
    norm = newNorm;
    if (stagnates) break;
  }
  report.relativeResidual = relativeResidual(system, solution);
  report.converged = std::isfinite(target) && norm <= target;
  return report;
}

}  // namespace asdfvk
