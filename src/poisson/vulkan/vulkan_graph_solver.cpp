#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "poisson/poisson_system.h"
#include "poisson/vulkan/vulkan_solver.h"

namespace asdfvk {
namespace {

class DeviceGraphSolver final : public GraphSolver {
 public:
  DeviceGraphSolver(DeviceMethod method, const Device& device, const VulkanEquationKernels& kernels,
                    const DualGraph& graph, std::span<const double> weights)
      : method_(std::move(method)),
        device_(device),
        kernels_(kernels),
        graph_(graph),
        weights_(weights),
        onDevice_(device, kernels, graph, weights) {}

  SolverReport solve(const GraphProblem& problem, const SolverOptions& options, std::span<double> values,
                     const RunControl& control) override {
    const SolverReport report = solveInFloat(problem, options, values, control);
    if (report.converged || report.iterations >= options.maxIterations) return report;
    SolverOptions remaining = options;
    remaining.maxIterations -= report.iterations;
    SolverReport further = solveInDouble(problem, remaining, values, control);
    further.iterations += report.iterations;
    return further;
  }

 private:
  /// Ends where the tolerance or kMinGraphTolerance is reached, and where float32 stagnates. Below that tolerance, and
  /// where float32 cannot represent the right-hand side, the result has not converged.
  [[nodiscard]] SolverReport solveInFloat(const GraphProblem& problem, const SolverOptions& options,
                                          std::span<double> values, const RunControl& control) const {
    VulkanEquation equation(device_, kernels_, onDevice_, problem);
    SolverReport report{.converged = false};
    const double target = std::max(options.tolerance, kMinGraphTolerance) * equation.rightHandNorm();
    SolverProgress progress(equation.rightHandNorm(), options, control);
    for (bool stagnates = false;
         !stagnates && equation.residualNorm() > target && report.iterations < options.maxIterations;) {
      const double norm = equation.residualNorm();
      progress.checkpoint(norm);
      const DevicePassResult result = method_.solve({.matrix = onDevice_.matrix,
                                                     .rightHandSide = equation.scaledResidual(),
                                                     .norm = norm,
                                                     .reduction = passReduction(target, norm, method_.minReduction),
                                                     .maxIterations = options.maxIterations - report.iterations,
                                                     .progress = progress});
      report.iterations += result.iterationCount;
      const double newNorm = equation.tryCorrection(result.solution);
      stagnates = passStagnates(newNorm, norm);
      if (newNorm <= norm) equation.accept();
    }
    equation.download(values);
    report.relativeResidual = equation.residualNorm() / equation.rightHandNorm();
    report.converged = options.tolerance >= kMinGraphTolerance && target > 0 && std::isfinite(target) &&
                       equation.residualNorm() <= target;
    return report;
  }

  /// Continues from the values.
  [[nodiscard]] SolverReport solveInDouble(const GraphProblem& problem, const SolverOptions& options,
                                           std::span<double> values, const RunControl& control) const {
    PoissonSystem system = buildPoissonSystem(graph_, weights_, problem.constraints, divergenceOf(problem),
                                              {.firstGuess = values, .componentOf = problem.componentOf});
    const SolverReport report = solveOnDevice(method_, device_, system, options, system.firstGuess, control);
    for (size_t i = 0; i < system.faces.size(); ++i) values[system.faces[i]] = system.firstGuess[i];
    return report;
  }

  [[nodiscard]] std::vector<double> divergenceOf(const GraphProblem& problem) const {
    std::vector<double> divergence(problem.divergence.begin(), problem.divergence.end());
    if (problem.guide.empty()) return divergence;
    std::vector<double> whole = asdfvk::divergenceOf(graph_, weights_, problem.guide);
    for (size_t face = 0; face < divergence.size(); ++face)
      if (std::isfinite(divergence[face])) whole[face] += divergence[face];
    return whole;
  }

  DeviceMethod method_;
  const Device& device_;
  const VulkanEquationKernels& kernels_;
  const DualGraph& graph_;
  std::span<const double> weights_;
  VulkanGraph onDevice_;
};

}  // namespace

std::unique_ptr<GraphSolver> VulkanSolver::onGraph(const DualGraph& graph, std::span<const double> weights) {
  if (!equationKernels_) equationKernels_.emplace(device_);
  return std::make_unique<DeviceGraphSolver>(method(), device_, *equationKernels_, graph, weights);
}

}  // namespace asdfvk
