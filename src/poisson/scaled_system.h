#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/unset_vector.h"
#include "poisson/poisson_system.h"
#include "shared/poisson_layout.h"

namespace asdfvk {

/// Greatest number of rows per call of ScaledSystem::multiplyRows(). With so few rows, the products are still in the
/// first-level cache when they are summed. The index of a row among these rows is stored in a byte.
inline constexpr size_t kRowsAtOnce = 256;
static_assert(kRowsAtOnce <= 256);

/// Scaling of a Poisson system by its diagonal D: A e = residual becomes (I - S) y = b with S = I - D^-1/2 A D^-1/2,
/// see shaders/shared/poisson_layout.h.
template <typename Real>
class DiagonalScaling {
 public:
  /// diagonal: #U, above 0, must outlive this object.
  explicit DiagonalScaling(std::span<const double> diagonal);

  /// #U: weights w. For r = b - (I - S) y, the sum of w_i r_i^2 is the square of residualNorm() of the corresponding
  /// residual of A e = residual.
  [[nodiscard]] const UnsetVector<Real>& residualWeights() const { return residualWeights_; }

  /// Returns b for A e = residual, scaled to the weighted norm 1. norm: residualNorm() of the residual.
  [[nodiscard]] UnsetVector<Real> scaleResidual(std::span<const double> residual, double norm) const;
  /// Computes e from y. norm: the result of scaleResidual().
  void unscaleCorrection(std::span<const Real> y, double norm, std::span<double> correction) const;

 protected:
  /// #U: D^-1/2.
  [[nodiscard]] static UnsetVector<double> inverseRoots(const PoissonSystem& system);

 private:
  std::span<const double> diagonal_;
  double meanDiagonal_ = 0;
  UnsetVector<Real> residualWeights_;
};

/// A Poisson system in scaled form and float32, for CpuCg and for tests of the kernels. Row i belongs to unknown i of
/// the system. The system must outlive this object.
class ScaledSystem : public DiagonalScaling<float> {
 public:
  using Real = float;
  static float rounding() { return kCgFloatRounding; }  ///< See CgRules::nextCgStep().

  explicit ScaledSystem(const PoissonSystem& system);

  [[nodiscard]] uint32_t unknownCount() const { return static_cast<uint32_t>(rows_.size()); }
  [[nodiscard]] const UnsetVector<PoissonRow>& rows() const { return rows_; }  ///< #U, the matrix S.
  [[nodiscard]] const UnsetVector<uint32_t>& tailColumns() const { return tailColumns_; }
  [[nodiscard]] const UnsetVector<float>& tailCouplings() const { return tailCouplings_; }

  /// product = (I - S) p for the rows [begin, end). p: #U. begin: a multiple of kRowsAtOnce; end: 1 to kRowsAtOnce
  /// more.
  void multiplyRows(const float* p, float* product, size_t begin, size_t end) const;

 private:
  UnsetVector<PoissonRow> rows_;
  UnsetVector<uint32_t> tailColumns_;
  UnsetVector<float> tailCouplings_;
  UnsetVector<uint8_t> tailRows_;  // The row of each entry of a tail, modulo kRowsAtOnce.
};

}  // namespace asdfvk
