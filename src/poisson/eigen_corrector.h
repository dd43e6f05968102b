#pragma once

#include "poisson/poisson_system.h"
#include "poisson/refinement.h"
#include "poisson/solver_progress.h"

namespace asdfvk {

/// Jacobi-preconditioned conjugate gradients in double, see makeEigenSolver(). What is given must outlive it.
[[nodiscard]] Corrector makeEigenCorrector(const PoissonSystem& system, SolverProgress& progress);

}  // namespace asdfvk
