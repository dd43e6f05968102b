#include "poisson/solver_progress.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {

SolverProgress::SolverProgress(const PoissonSystem& system, const SolverOptions& options, const RunControl& control)
    : control_(control), target_(options.tolerance * residualNorm(system, system.rightHandSide)) {}

void SolverProgress::checkpoint(double residualNorm) {
  if (first_ == 0) first_ = residualNorm;
  if (residualNorm > 0 && target_ > 0 && first_ > target_) {
    const double done = std::log(first_ / residualNorm) / std::log(first_ / target_);
    if (std::isfinite(done)) fraction_ = std::max(fraction_, std::clamp(done, 0.0, 1.0));
  }
  control_.checkpoint(fraction_);
}

}  // namespace asdfvk
