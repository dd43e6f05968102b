#include "poisson/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "core/unset_vector.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

// A pass reduces the residual a little more than necessary, so that rounding errors of the pass do not require a
// further pass.
constexpr double kSafety = 0.9;
// A pass that leaves more than this share of the residual has reached the limit of its precision.
constexpr double kStagnation = 0.5;

void setFirstGuess(const PoissonSystem& system, std::span<double> solution) {
  ASDFVK_CHECK_OP(solution.size(), ==, system.faces.size());
  if (system.firstGuess.empty())
    std::fill(solution.begin(), solution.end(), system.constraintMean);
  else if (solution.data() != system.firstGuess.data())
    std::copy(system.firstGuess.begin(), system.firstGuess.end(), solution.begin());
}

}  // namespace

void SolverProgress::checkpoint(double residualNorm) {
  if (first_ == 0) first_ = residualNorm;
  if (residualNorm > 0 && target_ > 0 && first_ > target_) {
    const double done = std::log(first_ / residualNorm) / std::log(first_ / target_);
    if (std::isfinite(done)) fraction_ = std::max(fraction_, std::clamp(done, 0.0, 1.0));
  }
  control_.checkpoint(fraction_);
}

double passReduction(double targetNorm, double norm, double minReduction) {
  return std::max(kSafety * targetNorm / norm, minReduction);
}

bool passStagnates(double newNorm, double norm) { return !(newNorm <= kStagnation * norm); }

SolverReport solveByRefinement(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                               const std::vector<Corrector>& correctors) {
  SolverReport report;
  setFirstGuess(system, solution);
  const double normOfRightHandSide = rightHandNorm(system);
  if (normOfRightHandSide == 0) {
    std::fill(solution.begin(), solution.end(), 0.0);
    return report;
  }
  const double target = options.tolerance * normOfRightHandSide;
  UnsetVector<double> residual(solution.size());
  computeResidual(system, solution, residual);
  double norm = residualNorm(system, residual);
  for (auto corrector = correctors.begin(); corrector != correctors.end();) {
    if (!(norm > target) || report.iterations >= options.maxIterations) break;
    report.iterations += corrector->correct({.residual = residual,
                                             .norm = norm,
                                             .reduction = passReduction(target, norm, corrector->minReduction),
                                             .maxIterations = options.maxIterations - report.iterations,
                                             .correction = residual});
    UnsetVector<double> corrected = std::move(residual);
    forEachInParallel(solution.size(), [&](size_t row) { corrected[row] += solution[row]; });
    residual.resize(solution.size());  // Allocated after the corrector has released its memory.
    computeResidual(system, corrected, residual);
    const double newNorm = residualNorm(system, residual);  // Not finite if the correction is not finite.
    const bool helps = newNorm <= norm, stagnates = passStagnates(newNorm, norm);
    if (helps) {
      std::copy(corrected.begin(), corrected.end(), solution.begin());
      norm = newNorm;
    } else {
      computeResidual(system, solution, residual);
    }
    if (stagnates) ++corrector;
  }
  report.relativeResidual = norm == 0 ? 0 : norm / normOfRightHandSide;
  report.converged = std::isfinite(target) && norm <= target;
  return report;
}

}  // namespace asdfvk
