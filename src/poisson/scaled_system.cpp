#include "poisson/scaled_system.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "poisson/ordered_sum.h"

namespace asdfvk {
namespace {

template <typename Body>
void forEachRow(size_t rowCount, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, rowCount, 4096), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t row = range.begin(); row < range.end(); ++row) body(row);
  });
}

}  // namespace

ScaledSystem::ScaledSystem(const PoissonSystem& system)
    : system_(system), couplings_(system.columns.size()), residualWeights_(system.faces.size()) {
  const size_t rowCount = system.faces.size();
  meanDiagonal_ =
      orderedSum(rowCount, [&](size_t row) { return system.diagonal[row] / static_cast<double>(rowCount); });
  for (size_t row = 0; row < rowCount; ++row)
    longestRow_ = std::max(longestRow_, system.rowOffsets[row + 1] - system.rowOffsets[row]);
  forEachRow(rowCount, [&](size_t row) {
    const double root = std::sqrt(system.diagonal[row]);
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      couplings_[i] = static_cast<float>(system.weights[i] / root / std::sqrt(system.diagonal[system.columns[i]]));
    residualWeights_[row] = static_cast<float>(system.diagonal[row] / meanDiagonal_);
  });
}

std::vector<float> ScaledSystem::scaleResidual(std::span<const double> residual, double norm) const {
  std::vector<float> scaled(residual.size());
  forEachRow(scaled.size(), [&](size_t row) {
    scaled[row] = static_cast<float>(residual[row] / norm * std::sqrt(meanDiagonal_ / system_.diagonal[row]));
  });
  return scaled;
}

void ScaledSystem::unscaleCorrection(std::span<const float> y, double norm, std::span<double> correction) const {
  // The roots apart from each other, so that their product neither overflows nor underflows.
  const double scale = norm / std::sqrt(meanDiagonal_);
  forEachRow(correction.size(), [&](size_t row) {
    correction[row] = static_cast<double>(y[row]) * (scale / std::sqrt(system_.diagonal[row]));
  });
}

}  // namespace asdfvk
