#pragma once

#include <span>
#include <vector>

#include "poisson/vulkan/vulkan_matrix.h"
#include "shared/poisson_layout.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

namespace asdfvk {

/// The two kernels of one iteration, made once per device: shaders/cg_*.comp.
struct VulkanCgKernels {
  explicit VulkanCgKernels(const Device& device);

  ComputePipeline product, step;
};

/// Conjugate gradients on (I - S) y = b from y = 0 on, all vectors and scalars on the device. Everything given must
/// outlive it.
class VulkanCg {
 public:
  /// rightHandSide: #U, of weighted norm 1. It has converged when the residual's is at or below `reduction`.
  VulkanCg(const Device& device, const VulkanCgKernels& kernels, const VulkanMatrix& matrix,
           std::span<const float> rightHandSide, double reduction);

  /// Runs up to `iterationCount` iterations in one submission, fewer when it converges or breaks down before one of
  /// them; those that are left then cost next to nothing.
  CgState advance(uint32_t iterationCount);

  /// Workgroups of the next dispatch: 0 once it has converged or broken down.
  [[nodiscard]] uint32_t workgroupCount() const;
  [[nodiscard]] std::vector<float> solution() const { return download(solution_); }
  [[nodiscard]] std::vector<float> residual() const { return download(residual_); }
  [[nodiscard]] std::vector<float> direction() const { return download(direction_); }
  [[nodiscard]] std::vector<float> product() const { return download(product_); }

 private:
  [[nodiscard]] std::vector<float> download(const Buffer& vector) const;

  const Device& device_;
  const VulkanCgKernels& kernels_;
  uint32_t unknownCount_;
  uint32_t stateIndex_ = 0;
  Buffer solution_, residual_, direction_, product_, states_, sums_;
  Buffer size_;  ///< Of all dispatches to come, set to 0 by the device when there is no more to do.
  Buffer statesOnHost_;
  BindingSet productBindings_, stepBindings_;
  CommandList commands_;
};

}  // namespace asdfvk
