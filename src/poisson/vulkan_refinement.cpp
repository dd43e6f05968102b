#include "poisson/vulkan_refinement.h"

#include <optional>

#include "poisson/refinement.h"

namespace asdfvk {

SolverReport solveOnDevice(const std::string& name, const Device& device, const PoissonSystem& system,
                           const SolverOptions& options, double strongestReduction, std::span<double> solution,
                           const RunControl& control, const DeviceSolver& solver) {
  SolverProgress progress(system, options, control);
  const ScaledSystem scaled(system);
  std::optional<VulkanMatrix> matrix;
  return solveByRefinement(name, system, options, strongestReduction, solution, [&](const CorrectionRequest& request) {
    if (!matrix) matrix.emplace(device, scaled);
    const double norm = residualNorm(system, request.residual);
    progress.checkpoint(norm);
    const auto rightHandSide = scaled.scaleResidual(request.residual, norm);
    const DevicePassResult result =
        solver({*matrix, rightHandSide, norm, request.reduction, request.maxIterations, progress});
    scaled.unscaleCorrection(result.solution, norm, request.correction);
    return result.iterationCount;
  });
}

}  // namespace asdfvk
