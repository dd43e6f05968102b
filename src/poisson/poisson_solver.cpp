#include "poisson/poisson_solver.h"

#include <fmt/core.h>

#include <algorithm>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

/// The first solver that needs a device is the default on a device, the first solver that needs none is the default on
/// the CPU.
constexpr std::array kSolvers{
    Solver{.name = "cg", .needsDevice = true, .storageBufferCount = 8, .make = makeVulkanCgSolver},
    Solver{.name = "jacobi", .needsDevice = true, .storageBufferCount = 8, .make = makeVulkanJacobiSolver},
    Solver{.name = "cpu", .needsDevice = false, .storageBufferCount = 0, .make = makeCpuCgSolver},
    Solver{.name = "eigen", .needsDevice = false, .storageBufferCount = 0, .make = makeEigenSolver},
};

}  // namespace

std::span<const Solver> solverTable() { return kSolvers; }

const Solver& findSolver(std::string_view name) {
  const auto found =
      std::find_if(kSolvers.begin(), kSolvers.end(), [&](const Solver& solver) { return solver.name == name; });
  if (found == kSolvers.end())
    throw Error(ErrorCode::UnknownName, fmt::format("no solver is called '{}'", name), {{"name", std::string(name)}});
  return *found;
}

const Solver& defaultSolver(bool needsDevice) {
  return *std::find_if(kSolvers.begin(), kSolvers.end(),
                       [&](const Solver& solver) { return solver.needsDevice == needsDevice; });
}

void requireUsable(const Solver& solver, bool hasDevice) {
  if (solver.needsDevice && !hasDevice)
    throw Error(ErrorCode::NoDeviceForKernel,
                fmt::format("the solver {} runs on a Vulkan device and this backend has none", solver.name));
}

std::unique_ptr<PoissonSolver> makeSolver(std::string_view name, const Device* device) {
  const Solver& solver = findSolver(name);
  requireUsable(solver, device != nullptr);
  return solver.make(device);
}

}  // namespace asdfvk
