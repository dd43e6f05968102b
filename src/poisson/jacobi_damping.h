#pragma once

#include "poisson/poisson_system.h"

namespace asdfvk {

/// The share of its step that a Jacobi iteration holds back so that it converges, in [0, 1): 0, the plain iteration,
/// where no eigenvalue of D^-1 A is above 2, as always of the first order. Above, steps are shortened by Gershgorin's
/// bound on them, the largest sum of |D^-1 A| over a row: 2.8 for uniform weights and beta 3.
[[nodiscard]] double heldBackByJacobi(const PoissonSystem& system);

}  // namespace asdfvk
