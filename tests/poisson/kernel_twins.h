#pragma once

#include <cmath>
#include <vector>

#include "poisson/poisson_system.h"

namespace asdfvk {

/// The results of the kernels in double, directly from the definition of the system; independent of src/poisson.
struct KernelTwins {
  const PoissonSystem& system;
  double meanDiagonal = 0;

  using Vector = std::vector<double>;

  explicit KernelTwins(const PoissonSystem& theSystem) : system(theSystem) {
    for (double d : system.diagonal) meanDiagonal += d / static_cast<double>(system.diagonal.size());
  }

  /// The norm of D^-1 residual.
  [[nodiscard]] double norm(const Vector& residual) const {
    double squared = 0;
    for (size_t i = 0; i < residual.size(); ++i) squared += std::pow(residual[i] / system.diagonal[i], 2);
    return std::sqrt(squared);
  }

  /// b of (I - S) y = b for A e = residual, scaled so that norm(residual) becomes 1.
  [[nodiscard]] Vector scaled(const Vector& residual) const {
    const double whole = norm(residual);
    Vector b(residual.size());
    for (size_t i = 0; i < b.size(); ++i) b[i] = residual[i] / whole / std::sqrt(meanDiagonal * system.diagonal[i]);
    return b;
  }

  /// S v.
  [[nodiscard]] Vector coupled(const Vector& v) const {
    Vector result(v.size(), 0.0);
    for (size_t row = 0; row < v.size(); ++row)
      for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i) {
        const uint32_t column = system.columns[i];
        result[row] -= system.entries[i] / std::sqrt(system.diagonal[row] * system.diagonal[column]) * v[column];
      }
    return result;
  }

  /// The squared norm() of the scaled residual r, over its first value.
  [[nodiscard]] double squaredNorm(const Vector& r) const {
    double sum = 0;
    for (size_t i = 0; i < r.size(); ++i) sum += r[i] * r[i] * meanDiagonal / system.diagonal[i];
    return sum;
  }
};

[[nodiscard]] inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Textbook conjugate gradients on (I - S) y = b.
struct CgTwin {
  KernelTwins twins;
  std::vector<double> x, r, p, q;

  CgTwin(const PoissonSystem& system, const std::vector<double>& b)
      : twins{system}, x(b.size(), 0.0), r(b), p(b), q(b.size(), 0.0) {}

  void iterate() {
    const std::vector<double> coupled = twins.coupled(p);
    for (size_t i = 0; i < q.size(); ++i) q[i] = p[i] - coupled[i];
    const double rr = dot(r, r), alpha = rr / dot(p, q);
    for (size_t i = 0; i < q.size(); ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    const double beta = dot(r, r) / rr;
    for (size_t i = 0; i < q.size(); ++i) p[i] = r[i] + beta * p[i];
  }
};

}  // namespace asdfvk
