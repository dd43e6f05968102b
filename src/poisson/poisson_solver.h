#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "mesh/dual_graph.h"
#include "poisson/poisson_system.h"

/// Solvers of the Poisson equation. A new solver requires a file with its class, the declaration of its make function
/// here, and a row of the table in poisson_solver.cpp.
namespace asdfvk {

class Device;

/// One interpolation on a dual graph, as buildPoissonSystem() has it.
struct GraphProblem {
  std::span<const double> constraints;  ///< #F, NaN for a face without one.
  std::span<const double> firstGuess;   ///< #F; non-finite entries are replaced by the mean of the constraints.
  std::span<const double> guide;  ///< #F, or empty: a field, of which the equation has the divergenceOf(). A device
                                  ///< starts from its finite entries.
  std::span<const double> divergence;     ///< #F, or empty: further divergence; non-finite entries count as 0.
  std::span<const uint32_t> componentOf;  ///< #F
};

/// Down to this tolerance a GraphSolver needs no residuals in double.
inline constexpr double kMinGraphTolerance = 1e-6;

/// A solver on one dual graph with weights, for any constraints.
class GraphSolver {
 public:
  virtual ~GraphSolver() = default;

  /// The interpolation of buildPoissonSystem(). Writes the values of the unknown faces only. values: #F. Report and
  /// errors as PoissonSolver::solve().
  virtual SolverReport solve(const GraphProblem& problem, const SolverOptions& options, std::span<double> values,
                             const RunControl& control) = 0;
};

class PoissonSolver {
 public:
  virtual ~PoissonSolver() = default;

  /// For several interpolations of most faces of a graph: a solver on a device keeps their matrix there, which is the
  /// same for all. Null without a device. Solver, graph and weights must outlive it. Throws as solve().
  [[nodiscard]] virtual std::unique_ptr<GraphSolver> onGraph(const DualGraph&, std::span<const double> /*weights*/) {
    return nullptr;
  }

  /// Overwrites solution (#U), which may be the memory of system.firstGuess. The name in the report is empty. Throws
  /// Error{Cancelled}, Error{Device}; Error{EquationLimit} for a system that exceeds a limit of the device.
  virtual SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                             const RunControl& control) = 0;
};

/// device: where the solver runs, null for a solver that needs none; must outlive the solver. Solvers on a device
/// create their kernels here, once for many systems.
using MakeSolver = std::unique_ptr<PoissonSolver>(const Device* device);

/// Jacobi-preconditioned conjugate gradients in float32, under iterative refinement in double: on the device, and on
/// all cores of the CPU. Where float32 stagnates, the iteration of makeEigenSolver() continues on the CPU. As a
/// GraphSolver, residuals in float32 down to kMinGraphTolerance.
[[nodiscard]] MakeSolver makeVulkanCgSolver, makeCpuCgSolver;
/// Jacobi iterations in float32 on the device, under the same refinement: slow, for comparison.
[[nodiscard]] MakeSolver makeVulkanJacobiSolver;
/// Jacobi-preconditioned conjugate gradients in double on all cores of the CPU, with an Eigen matrix.
[[nodiscard]] MakeSolver makeEigenSolver;

struct Solver {
  const char* name;
  bool needsDevice;
  uint32_t storageBufferCount;  ///< That its kernels bind. The minimum of Vulkan is four.
  MakeSolver* make;
};

inline constexpr const char* kAutomaticSolver = "auto";  ///< Stands for defaultSolver(); not a row of the table.

[[nodiscard]] std::span<const Solver> solverTable();
/// Throws Error{UnknownName}.
[[nodiscard]] const Solver& findSolver(std::string_view name);
/// The default solver on a device, or the one on the CPU.
[[nodiscard]] const Solver& defaultSolver(bool needsDevice);
/// Throws Error{NoDeviceForKernel} for a solver that needs a device without one.
void requireUsable(const Solver& solver, bool hasDevice);
/// Throws Error{UnknownName}; the error of requireUsable() where `device` is null.
[[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(std::string_view name, const Device* device);

}  // namespace asdfvk
