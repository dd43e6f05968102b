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
      isReplaceable_(options.solver == kAutomaticSolver),
      name_(isReplaceable_ ? automaticSolver(backend).name : options.solver) {}

SolverReport EquationSolver::solve(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                                   std::vector<double>& values, const RunControl& control) {
  if (!isReplaceable_ || !findSolver(name_).needsDevice)
    return solveWithChosen(graph, weights, std::move(problem), values, control);
  try {
    // Passes a copy of the problem, because the CPU receives the problem if the device fails.
    return solveWithChosen(graph, weights, problem, values, control);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device) throw;
    warnings_.push_back(solvedOnCpu(error));
  }
  onGraph_.reset();
  name_ = defaultSolver(false).name;
  return solveWithChosen(graph, weights, std::move(problem), values, control);
}

SolverReport EquationSolver::solveWithChosen(const DualGraph& graph, std::span<const double> weights,
                                             GraphProblem problem, std::vector<double>& values,
                                             const RunControl& control) {
  if (!onGraph_) {
    std::unique_ptr<PoissonSolver>& solver = solvers_[name_];
    if (!solver) solver = makeSolver(name_, backend_.device());
    onGraph_ = solver->onGraph(graph, weights);
  }
  SolverReport report = onGraph_->solve(std::move(problem), options_, values, control);
  report.name = name_;
  return report;
}

}  // namespace asdfvk
