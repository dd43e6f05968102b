#include <optional>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "poisson/cpu_cg.h"
#include "poisson/vulkan/vulkan_system.h"

namespace asdfvk {
namespace {

class DeviceGraphSolver final : public GraphSolver {
 public:
  DeviceGraphSolver(DeviceMethod method, const Device& device, const DualGraph& graph, std::span<const double> weights)
      : method_(std::move(method)), device_(device), graph_(graph), weights_(weights) {
    PoissonSystem whole = wholePoissonSystem(graph, weights);
    matrix_.emplace(device, ScaledSystem(whole));
    diagonal_ = std::move(whole.diagonal);
    scaling_.emplace(diagonal_);
  }

  SolverReport solve(const GraphProblem& problem, const SolverOptions& options, std::span<double> values,
                     const RunControl& control) override {
    const GraphEquation equation(graph_, weights_, diagonal_, problem);
    selectUnknowns(equation);
    SolverProgress progress(equation.rightHandNorm(), options, control);
    const Corrector onDevice{method_.minReduction, [&](const CorrectionRequest& request) {
                               progress.checkpoint(request.norm);
                               const auto b = scaling_->scaleResidual(request.residual, request.norm);
                               const DevicePassResult result = method_.solve({*matrix_, b, request, progress});
                               scaling_->unscaleCorrection(result.solution, request.norm, request.correction);
                               return result.iterationCount;
                             }};
    std::vector<double> solution(equation.size());
    SolverReport report = solveByRefinement(equation, options, solution, {onDevice});
    if (!report.converged && method_.finishesOnCpu && report.iterations < options.maxIterations)
      report = finishOnCpu(problem, report, options, solution, progress);
    forEachInParallel(values.size(), [&](uint32_t face) {
      if (equation.isUnknown(face)) values[face] = solution[face];
    });
    return report;
  }

 private:
  void selectUnknowns(const GraphEquation& equation) {
    UnsetVector<float> weights(equation.size());
    forEachInParallel(weights.size(), [&](uint32_t face) {
      weights[face] = equation.isUnknown(face) ? scaling_->residualWeights()[face] : 0;
    });
    matrix_->setResidualWeights(device_, weights);
  }

  /// Continues where float32 stagnates.
  [[nodiscard]] SolverReport finishOnCpu(const GraphProblem& problem, const SolverReport& earlier,
                                         const SolverOptions& options, std::vector<double>& values,
                                         SolverProgress& progress) const {
    const PoissonSystem system = buildPoissonSystem(graph_, weights_, problem.constraints, problem.divergence,
                                                    {.firstGuess = values, .componentOf = problem.componentOf});
    SolverOptions remaining = options;
    remaining.maxIterations -= earlier.iterations;
    std::vector<double> solution(system.unknownCount());
    SolverReport report = solveByRefinement(system, remaining, solution, {makeDoubleCorrector(system, progress)});
    report.finishedOnCpu = report.iterations > 0;
    report.iterations += earlier.iterations;
    for (size_t i = 0; i < solution.size(); ++i) values[system.faces[i]] = solution[i];
    return report;
  }

  DeviceMethod method_;
  const Device& device_;
  const DualGraph& graph_;
  std::span<const double> weights_;
  UnsetVector<double> diagonal_;
  std::optional<DiagonalScaling<float>> scaling_;
  std::optional<VulkanMatrix> matrix_;
};

}  // namespace

std::unique_ptr<GraphSolver> makeDeviceGraphSolver(DeviceMethod method, const Device& device, const DualGraph& graph,
                                                   std::span<const double> weights) {
  return std::make_unique<DeviceGraphSolver>(std::move(method), device, graph, weights);
}

}  // namespace asdfvk
