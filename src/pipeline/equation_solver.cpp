#include "pipeline/equation_solver.h"

#include <utility>

#include "asdf_vk/error.h"
#include "describe/warnings.h"

namespace asdfvk {

EquationSolver::EquationSolver(const Options& options, const Backend& backend, Solvers& solvers,
                               std::vector<Warning>& warnings)
    : options_(options.solverOptions),
      backend_(backend),
      solvers_(solvers),
      warnings_(warnings),
      isReplaceable_(options.solver == SolverChoice::Automatic),
      choice_(isReplaceable_ ? backend.automaticSolver().choice : options.solver) {}

SolverReport EquationSolver::solve(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                                   std::vector<double>& values, const RunControl& control) {
  if (!isReplaceable_ || !solverOf(choice_).needsDevice)
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
  if (!onGraph_) {
    std::unique_ptr<PoissonSolver>& solver = solvers_[choice_];
    if (!solver) solver = backend_.makeSolver(choice_);
    onGraph_ = solver->onGraph(graph, weights);
  }
  SolverReport report = onGraph_->solve(std::move(problem), options_, values, control);
  report.name = nameOf(kSolverNames, choice_);
  return report;
}

}  // namespace asdfvk
