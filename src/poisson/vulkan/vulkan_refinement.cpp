#include "poisson/vulkan/vulkan_refinement.h"

#include <optional>

#include "poisson/cpu_cg.h"
#include "poisson/refinement.h"

namespace asdfvk {

SolverReport solveOnDevice(const DeviceMethod& method, const Device& device, const PoissonSystem& system,
                           const SolverOptions& options, std::span<double> solution, const RunControl& control) {
  SolverProgress progress(system, options, control);
  const ScaledSystem scaled(system);
  std::optional<VulkanMatrix> matrix;
  const auto correct = [&](const CorrectionRequest& request) {
    if (!matrix) matrix.emplace(device, scaled);
    progress.checkpoint(request.norm);
    const auto rightHandSide = scaled.scaleResidual(request.residual, request.norm);
    const DevicePassResult result =
        method.solver({*matrix, rightHandSide, request.norm, request.reduction, request.maxIterations, progress});
    scaled.unscaleCorrection(result.solution, request.norm, request.correction);
    return result.iterationCount;
  };
  std::vector<Corrector> correctors{{method.strongestReduction, correct}};
  bool finishesOnCpu = false;
  if (method.cpuFinishes) {
    const Corrector onCpu = makeDoubleCorrector(system, progress);
    correctors.push_back({onCpu.strongestReduction, [&finishesOnCpu, onCpu](const CorrectionRequest& request) {
                            finishesOnCpu = true;
                            return onCpu.correct(request);
                          }});
  }
  SolverReport report = solveByRefinement(method.name, system, options, solution, correctors);
  report.finishedOnCpu = finishesOnCpu;
  return report;
}

}  // namespace asdfvk
