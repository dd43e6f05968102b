#pragma once

#include "asdf_vk/run_control.h"
#include "poisson/poisson_solver.h"

namespace asdfvk {

/// Turns residuals into a fraction done: a Krylov or Jacobi iteration wins about the same factor each time, so progress
/// is told on a logarithmic scale from the first residual to the one asked for. It never goes back.
class SolverProgress {
 public:
  SolverProgress(const PoissonSystem& system, const SolverOptions& options, const RunControl& control);

  /// residualNorm: ||b - A x|| by the solver's own account. Throws Error{Cancelled}.
  void checkpoint(double residualNorm);

 private:
  const RunControl& control_;
  double target_;
  double first_ = 0;
  double fraction_ = 0;
};

}  // namespace asdfvk
