#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

void computeResidual(const PoissonSystem& system, std::span<const double> solution, std::span<double> residual) {
  ASDFVK_CHECK_OP(solution.size(), ==, system.faces.size());
  ASDFVK_CHECK_OP(residual.size(), ==, system.faces.size());
  forEachInParallel(system.faces.size(), [&](size_t row) {
    double sum = system.rightHandSide[row] - system.diagonal[row] * solution[row];
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      sum -= system.entries[i] * solution[system.columns[i]];
    residual[row] = sum;
  });
}

double residualNorm(const PoissonSystem& system, std::span<const double> residual) {
  return orderedNorm(residual.size(), [&](size_t row) { return residual[row] / system.diagonal[row]; });
}

double relativeResidual(const PoissonSystem& system, std::span<const double> solution) {
  std::vector<double> residual(solution.size());
  computeResidual(system, solution, residual);
  const double norm = residualNorm(system, residual);
  return norm == 0 ? 0 : norm / residualNorm(system, system.rightHandSide);
}

}  // namespace asdfvk
