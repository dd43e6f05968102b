#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "pipeline/lazy_backend.h"
#include "poisson/poisson_solver.h"

namespace asdfvk {

/// The solver of one computation: the one that the options name. With SolverChoice::Automatic it is
/// Backend::automaticSolver(); if the device fails, the solver of the CPU replaces it, and a warning contains the
/// reason.
class EquationSolver {
 public:
  /// The arguments must outlive this object.
  EquationSolver(const Options& options, LazyBackend& backend, std::vector<Warning>& warnings)
      : options_(options), backend_(backend), warnings_(warnings) {}

  /// Like GraphSolver::solve(). All calls have the same graph and weights, which must outlive this object.
  SolverReport solve(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                     std::vector<double>& values, const RunControl& control);

 private:
  SolverReport solveWithChosen(const DualGraph& graph, std::span<const double> weights, GraphProblem problem,
                               std::vector<double>& values, const RunControl& control);

  const Options& options_;
  LazyBackend& backend_;
  std::vector<Warning>& warnings_;
  std::optional<SolverChoice> choice_;    ///< Set at first use.
  std::unique_ptr<GraphSolver> onGraph_;  ///< Created at first use.
};

}  // namespace asdfvk
