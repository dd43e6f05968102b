#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "poisson/vk/vulkan_solver.h"

namespace asdfvk {
namespace {

class VulkanGraphSolver final : public GraphSolver {
 public:
  VulkanGraphSolver(const VulkanSolver& solver, const VulkanEquationKernels& kernels, const DualGraph& graph,
                    std::span<const double> weights)
      : solver_(solver),
        kernels_(kernels),
        graph_(graph),
        weights_(weights),
        onDevice_(solver.device(), kernels, graph, weights) {}

  SolverReport solve(GraphProblem problem, const SolverOptions& options, std::vector<double>& values,
                     const RunControl& control) override {
    values.assign(problem.constraints.begin(), problem.constraints.end());
    const SolverReport report = solveInFloat(problem, options, values, control);
    if (report.converged || report.iterations >= options.maxIterations) return report;
    SolverOptions remaining = options;
    remaining.maxIterations -= report.iterations;
    problem.firstGuess.assign(values.begin(), values.end());
    SolverReport further = solveInDouble(std::move(problem), remaining, values, control);
    further.finishedOnCpu = further.iterations > 0;
    further.iterations += report.iterations;
    return further;
  }

 private:
  /// Ends at the larger of the tolerance and kMinDeviceTolerance, or when float32 stagnates. The result has not
  /// converged if the tolerance is below kMinDeviceTolerance, or if float32 cannot represent the right-hand side.
  [[nodiscard]] SolverReport solveInFloat(const GraphProblem& problem, const SolverOptions& options,
                                          std::span<double> values, const RunControl& control) const {
    VulkanEquation equation(solver_.device(), kernels_, onDevice_, problem);
    SolverReport report{.converged = false};
    const double target = std::max(options.tolerance, kMinDeviceTolerance) * equation.rightHandNorm();
    SolverProgress progress(equation.rightHandNorm(), options, control);
    for (bool stagnates = false;
         !stagnates && equation.residualNorm() > target && report.iterations < options.maxIterations;) {
      const double norm = equation.residualNorm();
      progress.checkpoint(norm);
      const DevicePassResult result = solver_.solve({.matrix = onDevice_.matrix,
                                                     .rightHandSide = equation.scaledResidual(),
                                                     .norm = norm,
                                                     .reduction = passReduction(target, norm, solver_.minReduction()),
                                                     .maxIterations = options.maxIterations - report.iterations,
                                                     .progress = progress});
      report.iterations += result.iterationCount;
      const double newNorm = equation.tryCorrection(result.solution);
      stagnates = passStagnates(newNorm, norm);
      if (newNorm <= norm) equation.accept();
    }
    equation.download(values);
    report.relativeResidual = equation.residualNorm() / equation.rightHandNorm();
    report.converged = options.tolerance >= kMinDeviceTolerance && target > 0 && std::isfinite(target) &&
                       equation.residualNorm() <= target;
    return report;
  }

  /// Solves on the CPU, from the first guess of the problem.
  [[nodiscard]] SolverReport solveInDouble(GraphProblem problem, const SolverOptions& options, std::span<double> values,
                                           const RunControl& control) const {
    PoissonSystem system = systemOf(graph_, weights_, std::move(problem));
    const SolverReport report = solveByEigen(system, options, system.firstGuess, control);
    for (size_t i = 0; i < system.faces.size(); ++i) values[system.faces[i]] = system.firstGuess[i];
    return report;
  }

  const VulkanSolver& solver_;
  const VulkanEquationKernels& kernels_;
  const DualGraph& graph_;
  std::span<const double> weights_;
  VulkanGraph onDevice_;
};

}  // namespace

std::unique_ptr<GraphSolver> VulkanSolver::onGraph(const DualGraph& graph, std::span<const double> weights) {
  return std::make_unique<VulkanGraphSolver>(*this, equationKernels_, graph, weights);
}

}  // namespace asdfvk
