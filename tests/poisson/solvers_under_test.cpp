#include "solvers_under_test.h"

#include "poisson/vulkan/vulkan_cg.h"
#include "poisson/vulkan/vulkan_jacobi.h"

namespace asdfvk {

SolversUnderTest::SolversUnderTest() {
  solvers_.push_back({"eigen", makeEigenSolver(), 1e-12});
  solvers_.push_back({"cpu", makeCpuCgSolver(), 1e-12});
  solvers_.push_back({"cg", makeVulkanCgSolver(*device_), 1e-10});
  solvers_.push_back({"jacobi", makeVulkanJacobiSolver(*device_), 1e-7});
}

}  // namespace asdfvk
