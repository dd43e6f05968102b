#include "poisson/poisson_solver.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"

namespace asdfvk {
namespace {

/// The first solver that needs a device is the default on a device, the first solver that needs none is the default on
/// the CPU.
constexpr std::array kSolvers{
    Solver{.choice = SolverChoice::Cg, .needsDevice = true, .storageBufferCount = 8, .make = makeVulkanCgSolver},
    Solver{
        .choice = SolverChoice::Jacobi, .needsDevice = true, .storageBufferCount = 8, .make = makeVulkanJacobiSolver},
    Solver{.choice = SolverChoice::Cpu, .needsDevice = false, .storageBufferCount = 0, .make = makeCpuCgSolver},
    Solver{.choice = SolverChoice::Eigen, .needsDevice = false, .storageBufferCount = 0, .make = makeEigenSolver},
};

}  // namespace

PoissonSystem systemOf(const DualGraph& graph, std::span<const double> weights, GraphProblem problem) {
  std::vector<double> divergence = std::move(problem.divergence);
  if (!problem.guide.empty()) {
    std::vector<double> whole = divergenceOf(graph, weights, problem.guide);
    for (size_t face = 0; face < divergence.size(); ++face)
      if (std::isfinite(divergence[face])) whole[face] += divergence[face];
    divergence = std::move(whole);
  }
  return buildPoissonSystem(graph, weights, problem.constraints, divergence, problem.componentOf, problem.firstGuess);
}

std::span<const Solver> solverTable() { return kSolvers; }

const Solver& solverOf(SolverChoice choice) {
  const auto found =
      std::find_if(kSolvers.begin(), kSolvers.end(), [&](const Solver& solver) { return solver.choice == choice; });
  ASDFVK_CHECK(found != kSolvers.end());
  return *found;
}

const Solver& defaultSolver(bool needsDevice) {
  return *std::find_if(kSolvers.begin(), kSolvers.end(),
                       [&](const Solver& solver) { return solver.needsDevice == needsDevice; });
}

void requireUsable(const Solver& solver, bool hasDevice) {
  if (solver.needsDevice && !hasDevice)
    throw Error(ErrorCode::NoDeviceForKernel,
                fmt::format("the solver {} runs on a Vulkan device and this backend has none", nameOf(solver)));
}

std::unique_ptr<PoissonSolver> makeSolver(SolverChoice choice, const Device* device) {
  const Solver& solver = solverOf(choice);
  requireUsable(solver, device != nullptr);
  return solver.make(device);
}

}  // namespace asdfvk
