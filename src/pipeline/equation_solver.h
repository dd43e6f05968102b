#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "pipeline/backend.h"
#include "poisson/poisson_solver.h"

namespace asdfvk {

/// The solvers of a session, created at first use.
using Solvers = std::map<SolverChoice, std::unique_ptr<PoissonSolver>>;

/// The solver of one computation: the one that the options name. With SolverChoice::Automatic it is
/// Backend::automaticSolver(); if the device fails, the solver of the CPU replaces it, and a warning contains the
/// reason.
class EquationSolver {
 public:
  /// The arguments must outlive this object.
  EquationSolver(const Options& options, const Backend& backend, Solvers& solvers, std::vector<Warning>& warnings);

  /// Like GraphSolver::solve(). All calls have the same graph and weights, which must outlive this object.
  SolverReport solve(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                     std::vector<double>& values, const RunControl& control);

 private:
  SolverReport solveWithChosen(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                               std::vector<double>& values, const RunControl& control);

  const SolverOptions& options_;
  const Backend& backend_;
  Solvers& solvers_;
  std::vector<Warning>& warnings_;
  bool isReplaceable_;
  SolverChoice choice_;
  std::unique_ptr<GraphSolver> onGraph_;  ///< Created at first use.
};

}  // namespace asdfvk
