#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "poisson/poisson_solver.h"

namespace asdfvk {

/// What a solver is asked for in one pass: an approximation of the e with A e = residual.
struct CorrectionRequest {
  std::span<const double> residual;  ///< #U
  double norm = 0;                   ///< Its residualNorm(), > 0.
  double reduction = 0;              ///< residualNorm() at or below this share of the residual's is enough.
  uint32_t maxIterations = 0;
  std::span<double> correction;  ///< #U, e, to be written whole.
};

/// Returns the iterations spent.
using CorrectionSolver = std::function<uint32_t(const CorrectionRequest& request)>;

/// A solver in whatever precision it has.
struct Corrector {
  double strongestReduction = 0;  ///< The most that one pass of it can be asked for in its precision.
  CorrectionSolver correct;
};

/// Iterative refinement (Wilkinson 1963): from the first guess on, residuals in double, corrections by the first of the
/// `correctors`, until the true relative residual is within the tolerance or the iterations are spent. Where a pass no
/// longer helps the next corrector takes over, and after the last one it ends. A correction that is not finite or makes
/// it worse is not added. name: for the report. solution: #U, written whole.
[[nodiscard]] SolverReport solveByRefinement(const std::string& name, const PoissonSystem& system,
                                             const SolverOptions& options, std::span<double> solution,
                                             const std::vector<Corrector>& correctors);

}  // namespace asdfvk
