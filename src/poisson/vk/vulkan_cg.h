#pragma once

#include <utility>
#include <vector>

#include "poisson/vk/vulkan_system.h"
#include "shared/poisson_layout.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

namespace asdfvk {

/// The two kernels of an iteration, created once per device: shaders/poisson/cg_*.comp.
struct VulkanCgKernels {
  explicit VulkanCgKernels(const Device& device);

  ComputePipeline product, step;
};

/// Conjugate gradients on (I - S) y = b from y = 0, with all vectors and scalars on the device. The arguments must
/// outlive this object.
class VulkanCg {
 public:
  /// rightHandSide: #U, of weighted norm 1. The iteration converges when the weighted norm of the residual is at most
  /// `reduction`.
  VulkanCg(const Device& device, const VulkanCgKernels& kernels, const VulkanMatrix& matrix,
           const Buffer& rightHandSide, double reduction);

  /// Runs up to `iterationCount` iterations in one submission; stops at convergence or breakdown. The dispatches of the
  /// remaining iterations are empty.
  CgState advance(uint32_t iterationCount);

  /// Workgroups of the next dispatch: 0 after convergence or breakdown.
  [[nodiscard]] uint32_t workgroupCount() const;
  [[nodiscard]] std::vector<float> solution() const { return download(solution_); }
  /// Returns the solution, which remains on the device. Precondition: no other call follows.
  [[nodiscard]] Buffer takeSolution() { return std::move(solution_); }
  [[nodiscard]] std::vector<float> residual() const { return download(residual_); }
  [[nodiscard]] std::vector<float> direction() const { return download(direction_); }
  [[nodiscard]] std::vector<float> product() const { return download(product_); }

 private:
  [[nodiscard]] std::vector<float> download(const Buffer& vector) const;
  void recordStart();

  const Device& device_;
  const VulkanCgKernels& kernels_;
  const Buffer& rightHandSide_;
  uint32_t unknownCount_;
  uint32_t workgroupCount_;
  bool hasStarted_ = false;
  uint32_t stateIndex_ = 0;
  Buffer solution_, residual_, direction_, product_, states_, sums_;
  Buffer size_;  ///< DispatchSize of the following dispatches. The device sets this size to 0 at the end.
  Buffer statesOnHost_;
  BindingSet productBindings_, stepBindings_;
  CommandList commands_;
};

}  // namespace asdfvk
