#include "asdf_vk/error.h"
#include "core/no_vulkan.h"
#include "poisson/poisson_solver.h"

namespace asdfvk {

std::unique_ptr<PoissonSolver> makeVulkanCgSolver(const Device*) { throw Error(ErrorCode::NoUsableDevice, kNoVulkan); }

std::unique_ptr<PoissonSolver> makeVulkanJacobiSolver(const Device*) {
  throw Error(ErrorCode::NoUsableDevice, kNoVulkan);
}

}  // namespace asdfvk
