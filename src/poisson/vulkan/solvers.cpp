#include "poisson/solvers.h"

#include <fmt/format.h>

#include <array>

#include "asdf_vk/error.h"
#include "poisson/vulkan/vulkan_cg.h"
#include "poisson/vulkan/vulkan_jacobi.h"

namespace asdfvk {
namespace {

constexpr std::array kSolvers{
    SolverRow{"cg", true, [](const Device* device) { return makeVulkanCgSolver(*device); }},
    SolverRow{"jacobi", true, [](const Device* device) { return makeVulkanJacobiSolver(*device); }},
    SolverRow{"cpu", false, [](const Device*) { return makeCpuCgSolver(); }},
    SolverRow{"eigen", false, [](const Device*) { return makeEigenSolver(); }},
};

}  // namespace

std::span<const SolverRow> solverTable() { return kSolvers; }

std::unique_ptr<PoissonSolver> makeSolver(std::string_view name, const Device* device) {
  for (const SolverRow& row : kSolvers) {
    if (row.name != name) continue;
    if (row.needsDevice && device == nullptr)
      throw Error(ErrorCode::NoDeviceForKernel,
                  fmt::format("the solver {} runs on a Vulkan device and this backend has none", name));
    return row.make(device);
  }
  throw Error(ErrorCode::UnknownName, fmt::format("no solver is called '{}'", name));
}

}  // namespace asdfvk
