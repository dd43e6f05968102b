#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

class PoissonSolver {
 public:
  virtual ~PoissonSolver() = default;

  /// solution: one entry per unknown of the system, written whole. Throws Error{Cancelled}, Error{Device}.
  virtual SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                             const RunControl& control) = 0;
};

/// Jacobi-preconditioned conjugate gradients in float32 on all cores of the CPU, under iterative refinement; where
/// float32 does not get there, Eigen's in double carry on.
[[nodiscard]] std::unique_ptr<PoissonSolver> makeCpuCgSolver();

/// Jacobi-preconditioned conjugate gradients with Eigen, in double on the CPU, products on all cores.
[[nodiscard]] std::unique_ptr<PoissonSolver> makeEigenSolver();

}  // namespace asdfvk
