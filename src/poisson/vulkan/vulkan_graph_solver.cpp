#include <cmath>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "poisson/poisson_system.h"
#include "poisson/vulkan/vulkan_equation.h"

namespace asdfvk {
namespace {

// Smaller residuals consist of rounding errors of float32, and residuals in double decide.
constexpr double kMinTolerance = 1e-6;

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
    if (options.tolerance < kMinTolerance) return solveInDouble(problem, problem.firstGuess, options, values, control);
    VulkanEquation equation(device_, kernels_, onDevice_, problem);
    const SolverReport report = refine(equation, options, control);
    equation.download(values);
    if (report.converged || report.iterations >= options.maxIterations) return report;
    SolverOptions remaining = options;
    remaining.maxIterations -= report.iterations;
    SolverReport further =
        solveInDouble(problem, std::vector<double>(values.begin(), values.end()), remaining, values, control);
    further.iterations += report.iterations;
    return further;
  }

 private:
  /// Ends also where float32 stagnates.
  [[nodiscard]] SolverReport refine(VulkanEquation& equation, const SolverOptions& options,
                                    const RunControl& control) const {
    SolverReport report;
    const double target = options.tolerance * equation.rightHandNorm();
    if (target == 0) return report;
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
    report.relativeResidual = equation.residualNorm() / equation.rightHandNorm();
    report.converged = std::isfinite(target) && equation.residualNorm() <= target;
    return report;
  }

  [[nodiscard]] SolverReport solveInDouble(const GraphProblem& problem, std::span<const double> firstGuess,
                                           const SolverOptions& options, std::span<double> values,
                                           const RunControl& control) const {
    PoissonSystem system = buildPoissonSystem(graph_, weights_, problem.constraints, divergenceOf(problem),
                                              {.firstGuess = firstGuess, .componentOf = problem.componentOf});
    const SolverReport report = solveOnDevice(method_, device_, system, options, system.firstGuess, control);
    for (size_t i = 0; i < system.faces.size(); ++i) values[system.faces[i]] = system.firstGuess[i];
    return report;
  }

  [[nodiscard]] std::vector<double> divergenceOf(const GraphProblem& problem) const {
    std::vector<double> divergence(problem.divergence.begin(), problem.divergence.end());
    if (!problem.isGuided) return divergence;
    std::vector<double> ofGuess = asdfvk::divergenceOf(graph_, weights_, problem.firstGuess);
    for (size_t face = 0; face < divergence.size(); ++face)
      if (std::isfinite(divergence[face])) ofGuess[face] += divergence[face];
    return ofGuess;
  }

  DeviceMethod method_;
  const Device& device_;
  const VulkanEquationKernels& kernels_;
  const DualGraph& graph_;
  std::span<const double> weights_;
  VulkanGraph onDevice_;
};

}  // namespace

std::unique_ptr<GraphSolver> makeDeviceGraphSolver(DeviceMethod method, const Device& device,
                                                   const VulkanEquationKernels& kernels, const DualGraph& graph,
                                                   std::span<const double> weights) {
  return std::make_unique<DeviceGraphSolver>(std::move(method), device, kernels, graph, weights);
}

}  // namespace asdfvk
