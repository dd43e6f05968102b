#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "poisson/poisson_solver.h"

namespace asdfvk {

/// What a solver is asked for in one pass: an approximation of the e with A e = residual.
struct CorrectionRequest {
  std::span<const double> residual;  ///< #U
  double reduction = 0;              ///< residualNorm() at or below this share of the residual's is enough.
  uint32_t maxIterations = 0;
  std::span<double> correction;  ///< #U, e, to be written whole.
};

/// Returns the iterations spent.
using CorrectionSolver = std::function<uint32_t(const CorrectionRequest& request)>;

/// Iterative refinement (Wilkinson 1963): from the first guess on, residuals in double, corrections by `correct` in
/// whatever precision it has, until the true relative residual is within the tolerance, the iterations are spent, or a
/// pass no longer helps. A correction that is not finite or makes it worse is not added.
/// strongestReduction: the most that one pass of `correct` can be asked for in its precision.
/// name: for the report. solution: #U, written whole.
[[nodiscard]] SolverReport solveByRefinement(const std::string& name, const PoissonSystem& system,
                                             const SolverOptions& options, double strongestReduction,
                                             std::span<double> solution, const CorrectionSolver& correct);

}  // namespace asdfvk
