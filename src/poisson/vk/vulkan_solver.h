#pragma once

#include <memory>

#include "poisson/poisson_solver.h"
#include "poisson/vk/vulkan_equation.h"
#include "poisson/vk/vulkan_system.h"

namespace asdfvk {

/// A solver whose passes run on a device. A subclass has the kernels of its iteration.
class VulkanSolver : public PoissonSolver {
 public:
  /// The device must outlive this object.
  explicit VulkanSolver(const Device& device) : device_(device), equationKernels_(device) {}

  std::unique_ptr<GraphSolver> onGraph(const DualGraph& graph, std::span<const double> weights) final;

  [[nodiscard]] const Device& device() const { return device_; }
  /// Smallest reduction that one pass reaches in float32.
  [[nodiscard]] virtual double minReduction() const = 0;
  [[nodiscard]] virtual DevicePassResult solve(const DevicePass& pass) const = 0;

 private:
  const Device& device_;
  VulkanEquationKernels equationKernels_;
};

}  // namespace asdfvk
