#include <utility>

#include "poisson/poisson_solver.h"

namespace asdfvk {
namespace {

class CpuGraphSolver final : public GraphSolver {
 public:
  CpuGraphSolver(SolveSystem& solve, const DualGraph& graph, std::span<const double> weights)
      : solve_(solve), graph_(graph), weights_(weights) {}

  SolverReport solve(GraphProblem problem, const SolverOptions& options, std::vector<double>& values,
                     const RunControl& control) override {
    const std::span<const double> constraints = problem.constraints;
    // To save memory, the solution overwrites the first guess, and `values` is made after the system is released.
    PoissonSystem system = systemOf(graph_, weights_, std::move(problem));
    const SolverReport report = solve_(system, options, system.firstGuess, control);
    const std::vector<uint32_t> faces = std::move(system.faces);
    const std::vector<double> solution = std::move(system.firstGuess);
    system = {};
    values.assign(constraints.begin(), constraints.end());
    for (size_t i = 0; i < solution.size(); ++i) values[faces[i]] = solution[i];
    return report;
  }

 private:
  SolveSystem& solve_;
  const DualGraph& graph_;
  std::span<const double> weights_;
};

class CpuSolver final : public PoissonSolver {
 public:
  explicit CpuSolver(SolveSystem& solve) : solve_(solve) {}

  std::unique_ptr<GraphSolver> onGraph(const DualGraph& graph, std::span<const double> weights) override {
    return std::make_unique<CpuGraphSolver>(solve_, graph, weights);
  }

 private:
  SolveSystem& solve_;
};

}  // namespace

std::unique_ptr<PoissonSolver> makeCpuCgSolver(const Device*) { return std::make_unique<CpuSolver>(solveByCpuCg); }

std::unique_ptr<PoissonSolver> makeEigenSolver(const Device*) { return std::make_unique<CpuSolver>(solveByEigen); }

}  // namespace asdfvk
