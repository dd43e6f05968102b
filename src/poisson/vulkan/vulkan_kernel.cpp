#include "poisson/vulkan/vulkan_kernel.h"

#include "poisson/vulkan/vulkan_matrix.h"
#include "shared/poisson_layout.h"

namespace asdfvk {

ComputePipelineDescription describePoissonKernel(const DeviceFacts& facts, const std::string& name,
                                                 std::span<const uint32_t> spirv, uint32_t bindingCount,
                                                 bool withMatrix) {
  std::vector<VkDescriptorType> bindings(bindingCount, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  if (withMatrix) bindings[0] = VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
  return {name, spirv, bindings, sizeof(PoissonPush), {/* kLaneCount= */ poissonLaneCount(facts)}};
}

}  // namespace asdfvk
