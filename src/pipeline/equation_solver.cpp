#include "pipeline/equation_solver.h"

#include <utility>

#include "asdf_vk/error.h"
#include "describe/warnings.h"

namespace asdfvk {

SolverReport EquationSolver::solve(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                                   std::vector<double>& values, const RunControl& control) {
  if (!choice_) choice_ = backend_->solverFor(options_.solver);
  if (options_.solver != SolverChoice::Automatic || !solverOf(*choice_).needsDevice)
    return solveWithChosen(graph, weights, std::move(problem), values, control);
  try {
    // Passes a copy of the problem, because the CPU receives the problem if the device fails.
    return solveWithChosen(graph, weights, problem, values, control);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device) throw;
    warnings_.push_back(solvedOnCpu(error));
  }
  onGraph_.reset();
  choice_ = defaultSolver(false).choice;
  return solveWithChosen(graph, weights, std::move(problem), values, control);
}

SolverReport EquationSolver::solveWithChosen(const DualGraph& graph, std::span<const double> weights,
                                             GraphProblem problem, std::vector<double>& values,
                                             const RunControl& control) {
  if (!onGraph_) onGraph_ = backend_.solver(*choice_).onGraph(graph, weights);
  SolverReport report = onGraph_->solve(std::move(problem), options_.solverOptions, values, control);
  report.name = nameOf(kSolverNames, *choice_);
  return report;
}

}  // namespace asdfvk
