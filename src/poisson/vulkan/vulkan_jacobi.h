#pragma once

#include <span>
#include <vector>

#include "poisson/vulkan/vulkan_matrix.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

namespace asdfvk {

/// The kernel of a Jacobi iteration, made once per device: shaders/jacobi_sweep.comp.
struct VulkanJacobiKernel {
  explicit VulkanJacobiKernel(const Device& device);

  ComputePipeline sweep;
};

/// Jacobi iterations on (I - S) y = b from y = 0 on. Everything given must outlive it.
class VulkanJacobi {
 public:
  /// rightHandSide: #U, of weighted norm 1.
  VulkanJacobi(const Device& device, const VulkanJacobiKernel& kernel, const VulkanMatrix& matrix,
               std::span<const float> rightHandSide);

  /// Runs `iterationCount` > 0 iterations in one submission. Returns the weighted norm of the residual before the last.
  double advance(uint32_t iterationCount);

  [[nodiscard]] std::vector<float> solution() const;

 private:
  const Device& device_;
  const VulkanJacobiKernel& kernel_;
  uint32_t unknownCount_;
  uint32_t workgroupCount_;
  uint32_t current_ = 0;  ///< The iterate that is newest.
  Buffer rightHandSide_, iterates_[2], sums_, sumsOnHost_;
  BindingSet bindings_[2];  ///< [i] reads iterates_[i] and writes the other one.
  CommandList commands_;
};

}  // namespace asdfvk
