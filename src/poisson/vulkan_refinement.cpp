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
  const auto correct = [&](const CorrectionRequest& request) {
    if (!matrix) matrix.emplace(device, scaled);
    progress.checkpoint(request.norm);
    const auto rightHandSide = scaled.scaleResidual(request.residual, request.norm);
    const DevicePassResult result =
        solver({*matrix, rightHandSide, request.norm, request.reduction, request.maxIterations, progress});
    scaled.unscaleCorrection(result.solution, request.norm, request.correction);
    return result.iterationCount;
  };
  return solveByRefinement(name, system, options, solution, {{strongestReduction, correct}});
}

}  // namespace asdfvk
