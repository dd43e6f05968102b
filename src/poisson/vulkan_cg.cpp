#include "poisson/vulkan_cg.h"

#include <array>
#include <cstring>

#include "poisson/vulkan_kernel.h"
#include "spirv/cg_direction.comp.h"
#include "spirv/cg_product.comp.h"
#include "spirv/cg_step.comp.h"

namespace asdfvk {
namespace {

Buffer uploadVector(const Device& device, std::span<const float> vector) {
  return uploadBuffer(device, std::as_bytes(vector), kPoissonVectorUsage);
}

std::array<CgState, 2> firstStates(std::span<const float> rightHandSide, double reduction) {
  double residualDot = 0;
  for (float entry : rightHandSide) residualDot += static_cast<double>(entry) * static_cast<double>(entry);
  const CgState state{.residualDot = static_cast<float>(residualDot),
                      .residualSquared = 1,
                      .toleranceSquared = static_cast<float>(reduction * reduction),
                      .iterationCount = 0,
                      .status = kCgRunning};
  return {state, state};
}

}  // namespace

VulkanCgKernels::VulkanCgKernels(const Device& device)
    : product(device, describePoissonKernel(device.facts(), "cg_product.comp", k_cg_product_comp, 7, true)),
      step(device, describePoissonKernel(device.facts(), "cg_step.comp", k_cg_step_comp, 7, false)),
      direction(device, describePoissonKernel(device.facts(), "cg_direction.comp", k_cg_direction_comp, 4, false)) {}

VulkanCg::VulkanCg(const Device& device, const VulkanCgKernels& kernels, const VulkanMatrix& matrix,
                   std::span<const float> rightHandSide, double reduction)
    : device_(device),
      kernels_(kernels),
      unknownCount_(static_cast<uint32_t>(rightHandSide.size())),
      workgroupCount_(matrix.grid.workgroupCount),
      solution_(uploadVector(device, std::vector<float>(rightHandSide.size(), 0.0f))),
      residual_(uploadVector(device, rightHandSide)),
      direction_(uploadVector(device, rightHandSide)),
      product_(uploadVector(device, std::vector<float>(rightHandSide.size(), 0.0f))),
      states_(uploadBuffer(device, bytesOf(firstStates(rightHandSide, reduction)), kPoissonVectorUsage)),
      sums_(uploadBuffer(device, bytesOf(PoissonSums{}), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)),
      stateOnHost_(device, sizeof(CgState), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::HostVisible),
      productBindings_(device, kernels.product,
                       std::array<Binding, 7>{matrix.rowTexels, matrix.tailColumns, matrix.tailCouplings, direction_,
                                              product_, states_, sums_}),
      stepBindings_(
          device, kernels.step,
          std::array<Binding, 7>{direction_, product_, matrix.residualWeights, solution_, residual_, states_, sums_}),
      directionBindings_(device, kernels.direction, std::array<Binding, 4>{residual_, direction_, states_, sums_}),
      commands_(device) {}

CgState VulkanCg::advance(uint32_t iterationCount) {
  commands_.begin();
  for (uint32_t i = 0; i < iterationCount; ++i) {
    const PoissonPush push{unknownCount_, stateIndex_, 0};
    commands_.dispatch(kernels_.product, productBindings_, bytesOf(push), workgroupCount_);
    commands_.barrier();
    commands_.dispatch(kernels_.step, stepBindings_, bytesOf(push), workgroupCount_);
    commands_.barrier();
    commands_.dispatch(kernels_.direction, directionBindings_, bytesOf(push), workgroupCount_);
    commands_.barrier();
    stateIndex_ = 1 - stateIndex_;
  }
  commands_.copy(states_, stateIndex_ * sizeof(CgState), stateOnHost_, 0, sizeof(CgState));
  commands_.barrier();
  commands_.submitAndWait();
  CgState state;
  std::memcpy(&state, stateOnHost_.mapped(), sizeof state);
  return state;
}

std::vector<float> VulkanCg::download(const Buffer& vector) const {
  std::vector<float> values(unknownCount_);
  downloadBuffer(device_, vector, std::as_writable_bytes(std::span(values)));
  return values;
}

}  // namespace asdfvk
