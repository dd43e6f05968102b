#include "poisson/vulkan/vulkan_jacobi_solver.h"

#include <algorithm>

#include "poisson/vulkan/vulkan_jacobi.h"
#include "poisson/vulkan/vulkan_refinement.h"

namespace asdfvk {
namespace {

// A stationary iteration loses nothing when it is restarted, and float32 cannot stall it over so short a way.
constexpr double kStrongestJacobiReduction = 1e-2;
// Fixed, because where it stops depends on it, and the same input must give the same bits.
constexpr uint32_t kBatch = 32;

class VulkanJacobiSolver final : public PoissonSolver {
 public:
  explicit VulkanJacobiSolver(const Device& device) : device_(device), kernel_(device) {}

  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) override {
    const auto solver = [this](const DevicePass& pass) { return iterate(pass); };
    return solveOnDevice(
        {.name = "jacobi", .strongestReduction = kStrongestJacobiReduction, .cpuFinishes = false, .solver = solver},
        device_, system, options, solution, control);
  }

 private:
  DevicePassResult iterate(const DevicePass& pass) const {
    VulkanJacobi jacobi(device_, kernel_, pass.matrix, pass.rightHandSide);
    uint32_t iterationCount = 0;
    for (double residual = 1; residual > pass.reduction && iterationCount < pass.maxIterations;) {
      const uint32_t batch = std::min(kBatch, pass.maxIterations - iterationCount);
      residual = jacobi.advance(batch);
      iterationCount += batch;
      pass.progress.checkpoint(pass.residualNorm * residual);
    }
    return {jacobi.solution(), iterationCount};
  }

  const Device& device_;
  VulkanJacobiKernel kernel_;
};

}  // namespace

std::unique_ptr<PoissonSolver> makeVulkanJacobiSolver(const Device& device) {
  return std::make_unique<VulkanJacobiSolver>(device);
}

}  // namespace asdfvk
