#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "poisson/poisson_solver.h"

/// Iterative refinement, the outer iteration of the solvers.
namespace asdfvk {

/// Reports the progress of a solver as a fraction of its work, from the residual. A Krylov or Jacobi iteration reduces
/// the residual by about the same factor each time, so the fraction is logarithmic between the first residual and the
/// target. The fraction never decreases.
class SolverProgress {
 public:
  /// rightHandNorm: residualNorm() of the right-hand side.
  SolverProgress(double rightHandNorm, const SolverOptions& options, const RunControl& control)
      : control_(control), target_(options.tolerance * rightHandNorm) {}

  /// residualNorm: ||D^-1 (b - A x)|| as the solver computes it. Throws Error{Cancelled}.
  void checkpoint(double residualNorm);

 private:
  const RunControl& control_;
  double target_;
  double first_ = 0;
  double fraction_ = 0;
};

/// Request of one pass: an approximate solution e of A e = residual.
struct CorrectionRequest {
  std::span<const double> residual;  ///< #U
  double norm = 0;                   ///< residualNorm() of `residual`, > 0.
  double reduction = 0;              ///< The pass may end when the norm is at or below this share of `norm`.
  uint32_t maxIterations = 0;
  std::span<double> correction;  ///< #U: receives e. Views the same memory as `residual`.
};

/// CorrectionRequest::reduction for the next pass. targetNorm: the norm of the residual at which the refinement ends.
/// norm: the current norm.
[[nodiscard]] double passReduction(double targetNorm, double norm, double minReduction);
/// Whether a pass has reached the limit of its precision.
[[nodiscard]] bool passStagnates(double newNorm, double norm);

/// Returns the number of iterations.
using CorrectionSolver = std::function<uint32_t(const CorrectionRequest& request)>;

/// A solver of any precision.
struct Corrector {
  double minReduction = 0;  ///< Smallest reduction that one pass reaches in its precision.
  CorrectionSolver correct;
};

/// Iterative refinement (Wilkinson 1963): residuals in double, corrections by the first of the `correctors`. The
/// refinement starts at the first guess. The refinement ends when the true relative residual is within the tolerance,
/// or at the iteration limit. If a pass stagnates, the next corrector is used. If the last corrector stagnates, the
/// refinement ends. A correction that is not finite or increases the residual is discarded. solution: #U, overwritten.
[[nodiscard]] SolverReport solveByRefinement(const PoissonSystem& system, const SolverOptions& options,
                                             std::span<double> solution, const std::vector<Corrector>& correctors);

}  // namespace asdfvk
