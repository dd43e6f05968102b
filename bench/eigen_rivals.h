#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "poisson/poisson_system.h"

namespace asdfvk::bench {

using EigenMatrix = Eigen::SparseMatrix<double>;

[[nodiscard]] EigenMatrix eigenMatrix(const PoissonSystem& system);

/// A solver of Eigen's own. Each starts at the mean of the known values and stops at ||r|| <= tolerance ||b||, which is
/// not relativeResidual() but close to it where weights are alike.
struct EigenRival {
  std::string name;
  /// Writes the solution, #U, whole; returns the iterations, 0 for a factorisation.
  uint32_t (*solve)(const EigenMatrix& matrix, const PoissonSystem& system, double tolerance,
                    std::span<double> solution);
};

/// Conjugate gradients with Jacobi's preconditioner and with incomplete Cholesky factors, and the factors L D L^T.
[[nodiscard]] std::vector<EigenRival> eigenRivals();

}  // namespace asdfvk::bench
