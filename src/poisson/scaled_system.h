#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poisson/poisson_system.h"
#include "shared/poisson_layout.h"

namespace asdfvk {

/// A Poisson system as devices solve it, in float32: (I - S) y = b with S = I - D^-1/2 A D^-1/2, see
/// shaders/shared/poisson_layout.h. Rows are those of the system, which must outlive this.
class ScaledSystem {
 public:
  explicit ScaledSystem(const PoissonSystem& system);

  [[nodiscard]] uint32_t unknownCount() const { return system_.unknownCount(); }
  [[nodiscard]] const UnsetVector<PoissonRow>& rows() const { return rows_; }  ///< #U, the matrix S.
  [[nodiscard]] const UnsetVector<uint32_t>& tailColumns() const { return tailColumns_; }
  [[nodiscard]] const UnsetVector<float>& tailCouplings() const { return tailCouplings_; }
  /// #U: the weights with which squares of b - (I - S) y add up to the squared residualNorm() of what is left.
  [[nodiscard]] const UnsetVector<float>& residualWeights() const { return residualWeights_; }
  [[nodiscard]] uint32_t longestRow() const { return longestRow_; }

  /// The right-hand side b for A e = residual, of weighted norm 1; norm: residualNorm() of the residual.
  [[nodiscard]] UnsetVector<float> scaleResidual(std::span<const double> residual, double norm) const;
  /// e from y; norm: as given to scaleResidual().
  void unscaleCorrection(std::span<const float> y, double norm, std::span<double> correction) const;

 private:
  const PoissonSystem& system_;
  double meanDiagonal_ = 0;
  uint32_t longestRow_ = 0;
  UnsetVector<PoissonRow> rows_;
  UnsetVector<uint32_t> tailColumns_;
  UnsetVector<float> tailCouplings_;
  UnsetVector<float> residualWeights_;
};

}  // namespace asdfvk
