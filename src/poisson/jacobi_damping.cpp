#include "poisson/jacobi_damping.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {
namespace {

constexpr double kRounding = 1e-9;  // The sums of an M-matrix come out a little above 2.
// At 2 / bound a mode at the bound would swing forever.
constexpr double kStepTimesBound = 1.9;

}  // namespace

double heldBackByJacobi(const PoissonSystem& system) {
  double bound = 0;
  for (size_t row = 0; row < system.faces.size(); ++row) {
    double sum = system.diagonal[row];
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i) sum += std::abs(system.entries[i]);
    bound = std::max(bound, sum / system.diagonal[row]);
  }
  return bound <= 2 + kRounding ? 0 : 1 - kStepTimesBound / bound;
}

}  // namespace asdfvk
