#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/unset_vector.h"
#include "poisson/refinement.h"
#include "poisson/scaled_system.h"
#include "shared/poisson_layout.h"

namespace asdfvk {

/// Conjugate gradients on (I - S) y = b from y = 0 on all cores of the CPU, with the same iteration as VulkanCg. Each
/// iteration makes two passes over the vectors. Sums are over blocks of fixed size, then over the blocks in order, so
/// that the bits do not depend on the number of threads. System: ScaledSystem (float32) or an Eigen matrix (double
/// precision).
template <typename System>
class CpuCg {
 public:
  using Real = typename System::Real;

  struct State {
    Real residualSquared = 1;  ///< Square of the weighted norm of the residual before the last iteration.
    uint32_t iterationCount = 0;
    uint32_t status = kCgRunning;  ///< kCgRunning, or the reason of the end.
  };

  /// rightHandSide: #U, of weighted norm 1. The iteration converges when the weighted norm of the residual is at most
  /// `reduction`. The system must outlive this object.
  CpuCg(const System& system, UnsetVector<Real> rightHandSide, double reduction);

  /// Runs up to `iterationCount` iterations; stops at convergence or breakdown.
  State advance(uint32_t iterationCount);

  [[nodiscard]] std::span<const Real> solution() const { return solution_; }
  [[nodiscard]] std::span<const Real> residual() const { return residual_; }
  [[nodiscard]] std::span<const Real> direction() const { return direction_; }
  [[nodiscard]] std::span<const Real> product() const { return product_; }

 private:
  using Rules = CgRules<Real>;
  using BlockSums = std::array<double, 6>;  ///< The sums in the order of CgSums.

  typename Rules::CgSums multiply();
  void step(Real alpha, Real beta);
  [[nodiscard]] BlockSums sumRows(size_t begin, size_t end) const;
  template <typename Body>
  void forEachBlock(const Body& body);

  const System& system_;
  Real toleranceSquared_;
  State state_;
  UnsetVector<Real> solution_, residual_, direction_, product_;
  std::vector<BlockSums> sums_;
  RepeatedLoop loop_;
};

}  // namespace asdfvk
