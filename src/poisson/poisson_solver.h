#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asdf_vk/choices.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "mesh/dual_graph.h"
#include "poisson/poisson_system.h"

/// Solvers of the Poisson equation. A new solver requires a file with its class, the declaration of its make function
/// here, and a row of the table in poisson_solver.cpp.
namespace asdfvk {

class Device;

/// One interpolation on a dual graph: arguments of buildPoissonSystem(). The solver may release the vectors.
struct GraphProblem {
  std::span<const double> constraints;  ///< #F, NaN for a face without a constraint.
  std::vector<double> firstGuess;       ///< #F; non-finite entries are replaced by the mean of the constraints.
  std::span<const double> guide;  ///< #F, or empty: a field whose divergenceOf() the equation includes. A device starts
                                  ///< from the finite entries of the field.
  std::vector<double> divergence;         ///< #F, or empty: further divergence; non-finite entries count as 0.
  std::span<const uint32_t> componentOf;  ///< #F
};

/// The linear system (buildPoissonSystem()) whose unknowns are the values of the faces without a constraint. Faces
/// without a path of arcs to a constraint are not unknowns.
[[nodiscard]] PoissonSystem systemOf(const DualGraph& graph, std::span<const double> weights, GraphProblem problem);

/// The least tolerance that a device reaches without residuals in double.
inline constexpr double kMinDeviceTolerance = 1e-6;

/// A solver on one dual graph with weights, for any constraints.
class GraphSolver {
 public:
  virtual ~GraphSolver() = default;

  /// values: receives the constraints and the solution, #F. `values` should be empty before the call, because a run
  /// needs the most memory while the CPU solves. The name in the report is empty. Throws Error{Cancelled},
  /// Error{Device}.
  virtual SolverReport solve(GraphProblem problem, const SolverOptions& options, std::vector<double>& values,
                             const RunControl& control) = 0;
};

class PoissonSolver {
 public:
  virtual ~PoissonSolver() = default;

  /// A solver of several interpolations on one graph. A device keeps the matrix, which all interpolations have in
  /// common. Solver, graph and weights must outlive the result. Throws Error{Device}; Error{EquationLimit} for a graph
  /// that exceeds a limit of the device.
  [[nodiscard]] virtual std::unique_ptr<GraphSolver> onGraph(const DualGraph& graph,
                                                             std::span<const double> weights) = 0;
};

/// Solves a system on the CPU. Overwrites solution (#U), which may be the memory of system.firstGuess. The name in the
/// report is empty. Throws Error{Cancelled}.
using SolveSystem = SolverReport(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                                 const RunControl& control);

/// Jacobi-preconditioned conjugate gradients in float32 under iterative refinement in double, on all cores. If float32
/// stagnates, solveByEigen() continues.
[[nodiscard]] SolveSystem solveByCpuCg;
/// Jacobi-preconditioned conjugate gradients in double on all cores, with an Eigen matrix.
[[nodiscard]] SolveSystem solveByEigen;

/// device: the device on which the solver runs, or null for a solver on the CPU; must outlive the solver. Solvers on a
/// device create their kernels here, once for many systems.
using MakeSolver = std::unique_ptr<PoissonSolver>(const Device* device);

/// Jacobi-preconditioned conjugate gradients in float32 on the device. If the tolerance is below kMinDeviceTolerance,
/// or if float32 stagnates, solveByEigen() continues on the CPU.
[[nodiscard]] MakeSolver makeVulkanCgSolver;
/// Like makeVulkanCgSolver with Jacobi iterations instead of conjugate gradients: slow, for comparison.
[[nodiscard]] MakeSolver makeVulkanJacobiSolver;
/// Solvers that build the system and call solveByCpuCg() or solveByEigen().
[[nodiscard]] MakeSolver makeCpuCgSolver, makeEigenSolver;

struct Solver {
  SolverChoice choice;
  bool needsDevice;
  uint32_t storageBufferCount;  ///< Number of storage buffers that a kernel binds. Vulkan guarantees four.
  MakeSolver* make;
};

[[nodiscard]] inline const char* nameOf(const Solver& solver) { return nameOf(kSolverNames, solver.choice); }

/// Without SolverChoice::Automatic, which stands for defaultSolver().
[[nodiscard]] std::span<const Solver> solverTable();
/// Precondition: not SolverChoice::Automatic.
[[nodiscard]] const Solver& solverOf(SolverChoice choice);
/// The default solver on a device if needsDevice, else the default solver on the CPU.
[[nodiscard]] const Solver& defaultSolver(bool needsDevice);
/// Throws Error{NoDeviceForKernel} if the solver needs a device and there is none.
void requireUsable(const Solver& solver, bool hasDevice);
/// device: may be null. Throws the error of requireUsable().
[[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(SolverChoice choice, const Device* device);

}  // namespace asdfvk
