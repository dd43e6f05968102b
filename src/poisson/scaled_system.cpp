#include "poisson/scaled_system.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/ordered_sum.h"
#include "core/parallel.h"

namespace asdfvk {
template <typename Real>
DiagonalScaling<Real>::DiagonalScaling(std::span<const double> diagonal)
    : diagonal_(diagonal), residualWeights_(diagonal.size()) {
  const auto rowCount = static_cast<double>(diagonal.size());
  meanDiagonal_ = orderedSum(diagonal.size(), [&](size_t row) { return diagonal[row] / rowCount; });
  forEachInParallel(diagonal.size(),
                    [&](size_t row) { residualWeights_[row] = static_cast<Real>(meanDiagonal_ / diagonal[row]); });
}

template <typename Real>
UnsetVector<double> DiagonalScaling<Real>::inverseRoots(const PoissonSystem& system) {
  UnsetVector<double> roots(system.faces.size());
  forEachInParallel(roots.size(), [&](size_t row) { roots[row] = 1 / std::sqrt(system.diagonal[row]); });
  return roots;
}

template <typename Real>
UnsetVector<Real> DiagonalScaling<Real>::scaleResidual(std::span<const double> residual, double norm) const {
  UnsetVector<Real> scaled(residual.size());
  forEachInParallel(scaled.size(), [&](size_t row) {
    scaled[row] = static_cast<Real>(residual[row] / norm / std::sqrt(meanDiagonal_) / std::sqrt(diagonal_[row]));
  });
  return scaled;
}

template <typename Real>
void DiagonalScaling<Real>::unscaleCorrection(std::span<const Real> y, double norm,
                                              std::span<double> correction) const {
  // Two roots instead of the root of the product, which could overflow or underflow.
  const double scale = norm * std::sqrt(meanDiagonal_);
  forEachInParallel(correction.size(), [&](size_t row) {
    correction[row] = static_cast<double>(y[row]) * (scale / std::sqrt(diagonal_[row]));
  });
}

template class DiagonalScaling<float>;
template class DiagonalScaling<double>;

ScaledSystem::ScaledSystem(const PoissonSystem& system) : DiagonalScaling(system.diagonal), rows_(system.faces.size()) {
  const size_t rowCount = system.faces.size();
  const auto lengthOf = [&](size_t row) { return system.rowOffsets[row + 1] - system.rowOffsets[row]; };
  const auto tailLengthOf = [&](size_t row) { return lengthOf(row) - std::min(lengthOf(row), kPoissonRowHeadLength); };
  const auto longestRow = maxInParallel<uint32_t>(rowCount, lengthOf);
  const bool hasTails = longestRow > kPoissonRowHeadLength;
  uint32_t tailSize = 0;
  for (size_t row = 0; hasTails && row < rowCount; ++row) {
    rows_[row].tailBegin = tailSize;
    tailSize += tailLengthOf(row);
  }
  tailColumns_.resize(tailSize);
  tailCouplings_.resize(tailSize);
  tailRows_.resize(tailSize);
  const UnsetVector<double> roots = inverseRoots(system);
  forEachInParallel(rowCount, [&](size_t row) {
    const auto coupling = [&](uint32_t i) {
      return static_cast<float>(-system.entries[i] * roots[row] * roots[system.columns[i]]);
    };
    const uint32_t begin = system.rowOffsets[row];
    std::array<uint32_t, kPoissonRowHeadLength> columns;
    std::array<float, kPoissonRowHeadLength> couplings{};
    columns.fill(static_cast<uint32_t>(row));
    for (uint32_t k = 0; k < std::min(lengthOf(row), kPoissonRowHeadLength); ++k) {
      columns[k] = system.columns[begin + k];
      couplings[k] = coupling(begin + k);
    }
    PoissonRow& entries = rows_[row];
    entries = {columns[0],   columns[1],   columns[2],   hasTails ? entries.tailBegin : 0,
               couplings[0], couplings[1], couplings[2], tailLengthOf(row)};
    for (uint32_t k = 0; k < entries.tailCount; ++k) {
      tailColumns_[entries.tailBegin + k] = system.columns[begin + kPoissonRowHeadLength + k];
      tailCouplings_[entries.tailBegin + k] = coupling(begin + kPoissonRowHeadLength + k);
      tailRows_[entries.tailBegin + k] = static_cast<uint8_t>(row % kRowsAtOnce);
    }
  });
}

void ScaledSystem::multiplyRows(const float* p, float* product, size_t begin, size_t end) const {
  const PoissonRow* rows = rows_.data();
  std::array<float, kRowsAtOnce> coupled;
  for (size_t i = begin; i < end; ++i) {
    const PoissonRow& row = rows[i];
    coupled[i - begin] =
        row.coupling0 * p[row.column0] + row.coupling1 * p[row.column1] + row.coupling2 * p[row.column2];
  }
  // One loop over the tails of all rows, because processors cannot predict the ends of one short loop per row.
  const uint32_t tailEnd = rows[end - 1].tailBegin + rows[end - 1].tailCount;
  for (uint32_t k = rows[begin].tailBegin; k < tailEnd; ++k)
    coupled[tailRows_[k]] += tailCouplings_[k] * p[tailColumns_[k]];
  for (size_t i = begin; i < end; ++i) product[i] = p[i] - coupled[i - begin];
}

}  // namespace asdfvk
