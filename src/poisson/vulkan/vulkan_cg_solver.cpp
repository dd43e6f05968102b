#include "poisson/vulkan/vulkan_cg_solver.h"

#include <algorithm>
#include <cmath>

#include "core/stopwatch.h"
#include "poisson/vulkan/vulkan_cg.h"
#include "poisson/vulkan/vulkan_refinement.h"

namespace asdfvk {
namespace {

// The residual that float32 recurs on leaves the true one at about 1e-7 of the first.
constexpr double kStrongestDeviceReduction = 1e-6;
// Iterations beyond convergence do nothing, so batches may grow freely; they are kept to what a user waits for.
constexpr uint32_t kFirstBatch = 8;
constexpr uint32_t kLargestBatch = 64;
constexpr double kBatchSeconds = 0.05;

class VulkanCgSolver final : public PoissonSolver {
 public:
  explicit VulkanCgSolver(const Device& device) : device_(device), kernels_(device) {}

  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) override {
    const auto solver = [this](const DevicePass& pass) { return iterate(pass); };
    return solveOnDevice(
        {.name = "cg", .strongestReduction = kStrongestDeviceReduction, .cpuFinishes = true, .solver = solver}, device_,
        system, options, solution, control);
  }

 private:
  DevicePassResult iterate(const DevicePass& pass) const {
    VulkanCg cg(device_, kernels_, pass.matrix, pass.rightHandSide, pass.reduction);
    CgState state{};
    uint32_t batch = kFirstBatch;
    for (uint32_t recorded = 0; state.status == kCgRunning && recorded < pass.maxIterations;) {
      const Stopwatch stopwatch;
      const uint32_t iterationCount = std::min(batch, pass.maxIterations - recorded);
      state = cg.advance(iterationCount);
      recorded += iterationCount;
      if (2 * stopwatch.seconds() < kBatchSeconds) batch = std::min(2 * batch, kLargestBatch);
      pass.progress.checkpoint(pass.residualNorm * std::sqrt(static_cast<double>(state.residualSquared)));
    }
    return {cg.solution(), state.iterationCount};
  }

  const Device& device_;
  VulkanCgKernels kernels_;
};

}  // namespace

std::unique_ptr<PoissonSolver> makeVulkanCgSolver(const Device& device) {
  return std::make_unique<VulkanCgSolver>(device);
}

}  // namespace asdfvk
