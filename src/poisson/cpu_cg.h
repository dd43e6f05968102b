#pragma once

#include <tbb/partitioner.h>

#include <array>
#include <cstddef>
#include <vector>

#include "poisson/scaled_system.h"
#include "shared/poisson_layout.h"

namespace asdfvk {

/// What VulkanCg does, on all cores of the CPU: float32 vectors, two passes over them per iteration, sums over blocks
/// of fixed size and then over the blocks in order, so that the bits do not depend on the number of threads.
class CpuCg {
 public:
  /// rightHandSide: #U, of weighted norm 1. It has converged when the residual's is at or below `reduction`. The system
  /// must outlive this.
  CpuCg(const ScaledSystem& system, UnsetVector<float> rightHandSide, double reduction);

  /// Up to `iterationCount` iterations, fewer when it converges or breaks down before one.
  CgState advance(uint32_t iterationCount);

  [[nodiscard]] std::span<const float> solution() const { return solution_; }
  [[nodiscard]] std::span<const float> residual() const { return residual_; }
  [[nodiscard]] std::span<const float> direction() const { return direction_; }
  [[nodiscard]] std::span<const float> product() const { return product_; }

 private:
  using BlockSums = std::array<double, 6>;  ///< In the order of CgSums.

  CgSums multiply();
  void step(float alpha, float beta);
  void multiplyRows(size_t begin, size_t end);
  [[nodiscard]] BlockSums sumRows(size_t begin, size_t end) const;
  template <typename Body>
  void forEachBlock(const Body& body);

  const ScaledSystem& system_;
  CgState state_{};
  UnsetVector<float> solution_, residual_, direction_, product_;
  std::vector<BlockSums> sums_;
  tbb::affinity_partitioner partitioner_;  ///< Each core keeps the blocks that its caches hold.
};

}  // namespace asdfvk
