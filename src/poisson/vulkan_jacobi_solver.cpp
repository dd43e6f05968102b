#include "poisson/vulkan_jacobi_solver.h"

#include <algorithm>
#include <optional>

#include "poisson/ordered_sum.h"
#include "poisson/refinement.h"
#include "poisson/solver_progress.h"
#include "poisson/vulkan_jacobi.h"

namespace asdfvk {
namespace {

// A stationary iteration loses nothing when it is restarted, and float32 cannot stall it over so short a way.
constexpr double kStrongestReduction = 1e-2;
// Fixed, because where it stops depends on it, and the same input must give the same bits.
constexpr uint32_t kBatch = 32;

class VulkanJacobiSolver final : public PoissonSolver {
 public:
  explicit VulkanJacobiSolver(const Device& device) : device_(device), kernel_(device) {}

  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) override {
    SolverProgress progress(system, options, control);
    const ScaledSystem scaled(system);
    std::optional<VulkanMatrix> matrix;
    return solveByRefinement("jacobi", system, options, kStrongestReduction, solution,
                             [&](const CorrectionRequest& request) {
                               if (!matrix) matrix.emplace(device_, scaled);
                               return correct(scaled, *matrix, request, progress);
                             });
  }

 private:
  uint32_t correct(const ScaledSystem& scaled, const VulkanMatrix& matrix, const CorrectionRequest& request,
                   SolverProgress& progress) const {
    const double norm = orderedNorm(request.residual);
    VulkanJacobi jacobi(device_, kernel_, matrix, scaled.scaleResidual(request.residual, norm));
    progress.checkpoint(norm);
    uint32_t iterationCount = 0;
    for (double residual = 1; residual > request.reduction && iterationCount < request.maxIterations;) {
      const uint32_t batch = std::min(kBatch, request.maxIterations - iterationCount);
      residual = jacobi.advance(batch);
      iterationCount += batch;
      progress.checkpoint(norm * residual);
    }
    scaled.unscaleCorrection(jacobi.solution(), norm, request.correction);
    return iterationCount;
  }

  const Device& device_;
  VulkanJacobiKernel kernel_;
};

}  // namespace

std::unique_ptr<PoissonSolver> makeVulkanJacobiSolver(const Device& device) {
  return std::make_unique<VulkanJacobiSolver>(device);
}

}  // namespace asdfvk
