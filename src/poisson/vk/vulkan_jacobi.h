#pragma once

#include <utility>
#include <vector>

#include "poisson/vk/vulkan_system.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

namespace asdfvk {

/// The kernel of an iteration, created once per device: shaders/poisson/jacobi_sweep.comp.
struct VulkanJacobiKernel {
  explicit VulkanJacobiKernel(const Device& device);

  ComputePipeline sweep;
};

/// Jacobi iterations on (I - S) y = b from y = 0. The arguments must outlive this object.
class VulkanJacobi {
 public:
  /// rightHandSide: #U, of weighted norm 1.
  VulkanJacobi(const Device& device, const VulkanJacobiKernel& kernel, const VulkanMatrix& matrix,
               const Buffer& rightHandSide);

  /// Runs `iterationCount` > 0 iterations in one submission. Returns the weighted norm of the residual before the last
  /// iteration.
  double advance(uint32_t iterationCount);

  [[nodiscard]] std::vector<float> solution() const;
  /// Returns the solution, which remains on the device. Precondition: no other call follows.
  [[nodiscard]] Buffer takeSolution() { return std::move(iterates_[current_]); }

 private:
  const Device& device_;
  const VulkanJacobiKernel& kernel_;
  uint32_t unknownCount_;
  PoissonGrid grid_;
  uint32_t current_ = 0;  ///< Index of the newest iterate.
  Buffer iterates_[2], sums_, sumsOnHost_;
  BindingSet bindings_[2];  ///< Entry i reads iterates_[i] and writes the other iterate.
  CommandList commands_;
};

}  // namespace asdfvk
