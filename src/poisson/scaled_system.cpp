#include "poisson/scaled_system.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/ordered_sum.h"
#include "core/parallel.h"

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
  const auto tailOf = [&](size_t row) {
    const uint32_t length = system.rowOffsets[row + 1] - system.rowOffsets[row];
    return length - std::min(length, kHeadLength);
  };
  longestRow_ = tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, rowCount), 0u,
      [&](const tbb::blocked_range<size_t>& range, uint32_t longest) {
        for (size_t row = range.begin(); row < range.end(); ++row)
          longest = std::max(longest, system.rowOffsets[row + 1] - system.rowOffsets[row]);
        return longest;
      },
      [](uint32_t a, uint32_t b) { return std::max(a, b); });
  const bool hasTails = longestRow_ > kHeadLength;
  for (size_t row = 0; hasTails && row < rowCount; ++row) {
    rows_[row].tailBegin = tailSize;
    tailSize += tailOf(row);
  }
  tailColumns_.resize(tailSize);
  tailCouplings_.resize(tailSize);
  UnsetVector<double> inverseRoots(rowCount);
  forEachInParallel(rowCount, [&](size_t row) {
    inverseRoots[row] = 1 / std::sqrt(system.diagonal[row]);
    residualWeights_[row] = static_cast<float>(meanDiagonal_ / system.diagonal[row]);
  });
  forEachInParallel(rowCount, [&](size_t row) {
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
    entries = {columns[0],   columns[1],   columns[2],   hasTails ? entries.tailBegin : 0,
               couplings[0], couplings[1], couplings[2], tailOf(row)};
    for (uint32_t k = 0; k < entries.tailCount; ++k) {
      tailColumns_[entries.tailBegin + k] = system.columns[begin + kHeadLength + k];
      tailCouplings_[entries.tailBegin + k] = coupling(begin + kHeadLength + k);
    }
  });
}

UnsetVector<float> ScaledSystem::scaleResidual(std::span<const double> residual, double norm) const {
  UnsetVector<float> scaled(residual.size());
  forEachInParallel(scaled.size(), [&](size_t row) {
    scaled[row] =
        static_cast<float>(residual[row] / norm / std::sqrt(meanDiagonal_) / std::sqrt(system_.diagonal[row]));
  });
  return scaled;
}

void ScaledSystem::unscaleCorrection(std::span<const float> y, double norm, std::span<double> correction) const {
  // The roots apart from each other, so that their product neither overflows nor underflows.
  const double scale = norm * std::sqrt(meanDiagonal_);
  forEachInParallel(correction.size(), [&](size_t row) {
    correction[row] = static_cast<double>(y[row]) * (scale / std::sqrt(system_.diagonal[row]));
  });
}

}  // namespace asdfvk
