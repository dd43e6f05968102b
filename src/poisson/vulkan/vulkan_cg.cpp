#include "poisson/vulkan/vulkan_cg.h"

#include <array>
#include <cstring>

#include "poisson/vulkan/vulkan_kernel.h"
#include "spirv/cg_product.comp.h"
#include "spirv/cg_step.comp.h"

namespace asdfvk {
namespace {

constexpr VkBufferUsageFlags kSizeUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

std::array<CgState, 2> firstStates(double reduction) {
  const CgState state{.residualSquared = 1,
                      .toleranceSquared = static_cast<float>(reduction * reduction),
                      .iterationCount = 0,
                      .status = kCgRunning};
  return {state, state};
}

Buffer makeVector(const Device& device, size_t count) {
  return {device, count * sizeof(float), kPoissonVectorUsage, MemoryKind::DeviceLocal};
}

}  // namespace

VulkanCgKernels::VulkanCgKernels(const Device& device)
    : product(device, describePoissonKernel(device.facts(), "cg_product.comp", k_cg_product_comp, 8, true)),
      step(device, describePoissonKernel(device.facts(), "cg_step.comp", k_cg_step_comp, 7, false)) {}

VulkanCg::VulkanCg(const Device& device, const VulkanCgKernels& kernels, const VulkanMatrix& matrix,
                   std::span<const float> rightHandSide, double reduction)
    : device_(device),
      kernels_(kernels),
      unknownCount_(static_cast<uint32_t>(rightHandSide.size())),
      solution_(makeVector(device, rightHandSide.size())),
      residual_(uploadBuffer(device, std::as_bytes(rightHandSide), kPoissonVectorUsage)),
      direction_(makeVector(device, rightHandSide.size())),
      product_(makeVector(device, rightHandSide.size())),
      states_(uploadBuffer(device, bytesOf(firstStates(reduction)), kPoissonVectorUsage)),
      sums_(uploadBuffer(device, bytesOf(PoissonSums{}), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)),
      size_(uploadBuffer(device, bytesOf(DispatchSize{matrix.grid.workgroupCount, 1, 1}), kSizeUsage)),
      statesOnHost_(device, 2 * sizeof(CgState), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::HostVisible),
      productBindings_(device, kernels.product,
                       std::array<Binding, 8>{matrix.rowTexels, matrix.tailColumns, matrix.tailCouplings,
                                              matrix.residualWeights, residual_, direction_, product_, sums_}),
      stepBindings_(device, kernels.step,
                    std::array<Binding, 7>{product_, solution_, residual_, direction_, sums_, states_, size_}),
      commands_(device) {
  commands_.begin();
  commands_.fillWithZeros(solution_);
  commands_.copy(residual_, 0, direction_, 0, rightHandSide.size_bytes());
  commands_.barrier();
  commands_.submitAndWait();
}

CgState VulkanCg::advance(uint32_t iterationCount) {
  commands_.begin();
  for (uint32_t i = 0; i < iterationCount; ++i) {
    const PoissonPush push{unknownCount_, stateIndex_};
    commands_.dispatchIndirect(kernels_.product, productBindings_, bytesOf(push), size_);
    commands_.barrier();
    commands_.dispatchIndirect(kernels_.step, stepBindings_, bytesOf(push), size_);
    commands_.barrier();
    stateIndex_ = 1 - stateIndex_;
  }
  commands_.copy(states_, 0, statesOnHost_, 0, 2 * sizeof(CgState));
  commands_.barrier();
  commands_.submitAndWait();
  std::array<CgState, 2> states;
  std::memcpy(&states, statesOnHost_.mapped(), sizeof states);
  // The iteration that ended it was the last to write, whichever that was.
  return states[1 - stateIndex_].status != kCgRunning ? states[1 - stateIndex_] : states[stateIndex_];
}

uint32_t VulkanCg::workgroupCount() const {
  DispatchSize size;
  downloadBuffer(device_, size_, std::as_writable_bytes(std::span<DispatchSize, 1>(&size, 1)));
  return size.x;
}

std::vector<float> VulkanCg::download(const Buffer& vector) const {
  std::vector<float> values(unknownCount_);
  downloadBuffer(device_, vector, std::as_writable_bytes(std::span(values)));
  return values;
}

}  // namespace asdfvk
