#include "poisson/vk/vulkan_jacobi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "poisson/vk/vulkan_solver.h"
#include "shared/poisson_layout.h"
#include "spirv/jacobi_sweep.comp.h"

namespace asdfvk {
namespace {

// A stationary iteration loses nothing by a restart, and float32 does not stagnate before the residual is reduced to
// this share.
constexpr double kJacobiMinReduction = 1e-2;
// Iterations per submission. The number is fixed, because it determines the end of the iteration, and the same input
// must give the same bits.
constexpr uint32_t kBatch = 32;
constexpr uint32_t kBindingCount = 8;

Buffer uploadZeros(const Device& device, size_t count) {
  return uploadBuffer(device, std::as_bytes(std::span<const float>(std::vector<float>(count, 0.0f))),
                      kPoissonVectorUsage);
}

std::array<Binding, kBindingCount> bind(const VulkanMatrix& matrix, const Buffer& rightHandSide, const Buffer& from,
                                        const Buffer& to, const Buffer& sums) {
  return {matrix.rows, matrix.tailColumns, matrix.tailCouplings, rightHandSide, matrix.residualWeights, from, to, sums};
}

class VulkanJacobiSolver final : public VulkanSolver {
 public:
  explicit VulkanJacobiSolver(const Device& device) : VulkanSolver(device), kernel_(device) {}

  [[nodiscard]] double minReduction() const override { return kJacobiMinReduction; }
  [[nodiscard]] DevicePassResult solve(const DevicePass& pass) const override {
    VulkanJacobi jacobi(device(), kernel_, pass.matrix, pass.rightHandSide);
    uint32_t iterationCount = 0;
    for (double norm = 1; norm > pass.reduction && iterationCount < pass.maxIterations;) {
      const uint32_t batch = std::min(kBatch, pass.maxIterations - iterationCount);
      norm = jacobi.advance(batch);
      iterationCount += batch;
      pass.progress.checkpoint(pass.norm * norm);
    }
    return {jacobi.takeSolution(), iterationCount};
  }

 private:
  VulkanJacobiKernel kernel_;
};

}  // namespace

VulkanJacobiKernel::VulkanJacobiKernel(const Device& device)
    : sweep(device, describePoissonKernel(device.facts(), "jacobi_sweep.comp", k_jacobi_sweep_comp, kBindingCount)) {}

VulkanJacobi::VulkanJacobi(const Device& device, const VulkanJacobiKernel& kernel, const VulkanMatrix& matrix,
                           const Buffer& rightHandSide)
    : device_(device),
      kernel_(kernel),
      unknownCount_(matrix.rowCount),
      grid_(matrix.grid),
      iterates_{uploadZeros(device, unknownCount_), uploadZeros(device, unknownCount_)},
      sums_(uploadBuffer(device, bytesOf(PoissonSums{}), kPoissonVectorUsage)),
      sumsOnHost_(device, sizeof(PoissonSums), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::HostVisible),
      bindings_{{device, kernel.sweep, bind(matrix, rightHandSide, iterates_[0], iterates_[1], sums_)},
                {device, kernel.sweep, bind(matrix, rightHandSide, iterates_[1], iterates_[0], sums_)}},
      commands_(device) {}

double VulkanJacobi::advance(uint32_t iterationCount) {
  commands_.begin();
  for (uint32_t i = 0; i < iterationCount; ++i) {
    commands_.dispatch(kernel_.sweep, bindings_[current_], bytesOf(PoissonPush{unknownCount_, 0, grid_.workgroupCount}),
                       grid_.workgroupCount);
    commands_.barrier();
    current_ = 1 - current_;
  }
  return rootOfSum(submitAndRead(commands_, sums_, sumsOnHost_).residualSquared, grid_);
}

std::vector<float> VulkanJacobi::solution() const {
  return downloadPoissonVector(device_, iterates_[current_], unknownCount_);
}

std::unique_ptr<PoissonSolver> makeVulkanJacobiSolver(const Device* device) {
  return std::make_unique<VulkanJacobiSolver>(*device);
}

}  // namespace asdfvk
