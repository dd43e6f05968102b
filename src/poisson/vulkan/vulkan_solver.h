#pragma once

#include <memory>
#include <optional>

#include "poisson/poisson_solver.h"
#include "poisson/vulkan/vulkan_equation.h"
#include "poisson/vulkan/vulkan_system.h"

namespace asdfvk {

/// A solver whose passes run on a device. A subclass has the kernels of its iteration.
class VulkanSolver : public PoissonSolver {
 public:
  /// The device must outlive it.
  explicit VulkanSolver(const Device& device) : device_(device) {}

  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) final {
    return solveOnDevice(method(), device_, system, options, solution, control);
  }
  std::unique_ptr<GraphSolver> onGraph(const DualGraph& graph, std::span<const double> weights) final;

 protected:
  [[nodiscard]] const Device& device() const { return device_; }
  /// Must not outlive this object.
  [[nodiscard]] virtual DeviceMethod method() const = 0;

 private:
  const Device& device_;
  std::optional<VulkanEquationKernels> equationKernels_;  ///< Created by the first onGraph().
};

}  // namespace asdfvk
