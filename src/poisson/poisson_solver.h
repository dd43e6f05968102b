#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/run_control.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

struct SolverOptions {
  double tolerance = 1e-4;  ///< On the relative residual, see relativeResidual().
  uint32_t maxIterations = 20000;
};

struct SolverReport {
  std::string name;  ///< "eigen", "cpu", "cg" or "jacobi".
  uint32_t iterations = 0;
  double relativeResidual = 0;  ///< The true one, recomputed in double from the solution.
  bool converged = true;        ///< Not converging is data, not an error.
  bool finishedOnCpu = false;   ///< Begun on a device in float32, which did not get there.
};

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
