#include "poisson/vulkan_cg_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/stopwatch.h"
#include "poisson/ordered_sum.h"
#include "poisson/refinement.h"
#include "poisson/solver_progress.h"
#include "poisson/vulkan_cg.h"

namespace asdfvk {
namespace {

// The residual that float32 recurs on leaves the true one at about 1e-7 of the first.
constexpr double kStrongestReduction = 1e-6;
// Iterations beyond convergence do nothing, so batches may grow freely; they are kept to what a user waits for.
constexpr uint32_t kFirstBatch = 8;
constexpr uint32_t kLargestBatch = 64;
constexpr double kBatchSeconds = 0.05;

class VulkanCgSolver final : public PoissonSolver {
 public:
  explicit VulkanCgSolver(const Device& device) : device_(device), kernels_(device) {}

  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) override {
    SolverProgress progress(system, options, control);
    const ScaledSystem scaled(system);
    std::optional<VulkanMatrix> matrix;
    return solveByRefinement("cg", system, options, kStrongestReduction, solution,
                             [&](const CorrectionRequest& request) {
                               if (!matrix) matrix.emplace(device_, scaled);
                               return correct(scaled, *matrix, request, progress);
                             });
  }

 private:
  uint32_t correct(const ScaledSystem& scaled, const VulkanMatrix& matrix, const CorrectionRequest& request,
                   SolverProgress& progress) const {
    const double norm = orderedNorm(request.residual);
    VulkanCg cg(device_, kernels_, matrix, scaled.scaleResidual(request.residual, norm), request.reduction);
    progress.checkpoint(norm);
    CgState state{};
    uint32_t batch = kFirstBatch;
    for (uint32_t recorded = 0; state.status == kCgRunning && recorded < request.maxIterations;) {
      const Stopwatch stopwatch;
      const uint32_t iterationCount = std::min(batch, request.maxIterations - recorded);
      state = cg.advance(iterationCount);
      recorded += iterationCount;
      if (2 * stopwatch.seconds() < kBatchSeconds) batch = std::min(2 * batch, kLargestBatch);
      progress.checkpoint(norm * std::sqrt(static_cast<double>(state.residualSquared)));
    }
    scaled.unscaleCorrection(cg.solution(), norm, request.correction);
    return state.iterationCount;
  }

  const Device& device_;
  VulkanCgKernels kernels_;
};

}  // namespace

std::unique_ptr<PoissonSolver> makeVulkanCgSolver(const Device& device) {
  return std::make_unique<VulkanCgSolver>(device);
}

}  // namespace asdfvk
