#include "poisson/scaled_system.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "poisson/each_row.h"
#include "poisson/ordered_sum.h"

namespace asdfvk {
namespace {

constexpr uint32_t kHeadLength = 3;  // Entries in a PoissonRow itself.

}  // namespace

ScaledSystem::ScaledSystem(const PoissonSystem& system)
    : system_(system), rows_(system.faces.size()), residualWeights_(system.faces.size()) {
  const size_t rowCount = system.faces.size();
  meanDiagonal_ =
      orderedSum(rowCount, [&](size_t row) { return system.diagonal[row] / static_cast<double>(rowCount); });
  uint32_t tailSize = 0;
  for (size_t row = 0; row < rowCount; ++row) {
    const uint32_t length = system.rowOffsets[row + 1] - system.rowOffsets[row];
    longestRow_ = std::max(longestRow_, length);
    rows_[row].tailBegin = tailSize;
    rows_[row].tailCount = length - std::min(length, kHeadLength);
    tailSize += rows_[row].tailCount;
  }
  tailColumns_.resize(tailSize);
  tailCouplings_.resize(tailSize);
  std::vector<double> inverseRoots(rowCount);
  forEachRow(rowCount, [&](size_t row) {
    inverseRoots[row] = 1 / std::sqrt(system.diagonal[row]);
    residualWeights_[row] = static_cast<float>(meanDiagonal_ / system.diagonal[row]);
  });
  forEachRow(rowCount, [&](size_t row) {
    const auto coupling = [&](uint32_t i) {
      return static_cast<float>(-system.entries[i] * inverseRoots[row] * inverseRoots[system.columns[i]]);
    };
    const uint32_t begin = system.rowOffsets[row], length = system.rowOffsets[row + 1] - begin;
    std::array<uint32_t, kHeadLength> columns;
    std::array<float, kHeadLength> couplings{};
    columns.fill(static_cast<uint32_t>(row));
    for (uint32_t k = 0; k < std::min(length, kHeadLength); ++k) {
      columns[k] = system.columns[begin + k];
      couplings[k] = coupling(begin + k);
    }
    PoissonRow& entries = rows_[row];
    entries = {columns[0],   columns[1],   columns[2],   entries.tailBegin,
               couplings[0], couplings[1], couplings[2], entries.tailCount};
    for (uint32_t k = 0; k < entries.tailCount; ++k) {
      tailColumns_[entries.tailBegin + k] = system.columns[begin + kHeadLength + k];
      tailCouplings_[entries.tailBegin + k] = coupling(begin + kHeadLength + k);
    }
  });
}

std::vector<float> ScaledSystem::scaleResidual(std::span<const double> residual, double norm) const {
  std::vector<float> scaled(residual.size());
  forEachRow(scaled.size(), [&](size_t row) {
    scaled[row] =
        static_cast<float>(residual[row] / norm / std::sqrt(meanDiagonal_) / std::sqrt(system_.diagonal[row]));
  });
  return scaled;
}

void ScaledSystem::unscaleCorrection(std::span<const float> y, double norm, std::span<double> correction) const {
  // The roots apart from each other, so that their product neither overflows nor underflows.
  const double scale = norm * std::sqrt(meanDiagonal_);
  forEachRow(correction.size(), [&](size_t row) {
    correction[row] = static_cast<double>(y[row]) * (scale / std::sqrt(system_.diagonal[row]));
  });
}

}  // namespace asdfvk
