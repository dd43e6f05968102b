#include "trace/vulkan_cone_kernel.h"

#include "shared/cone_layout.h"
#include "spirv/trace_cone.comp.h"

namespace asdfvk {

VulkanConeKernel::VulkanConeKernel(const Device& device, uint32_t rayCount)
    : VulkanConeKernel(device, rayCount, workgroupShapeFor(device.facts(), rayCount)) {}

VulkanConeKernel::VulkanConeKernel(const Device& device, uint32_t rayCount, const VulkanWorkgroupShape& shape)
    : device_(device),
      rayCount_(rayCount),
      shape_(shape),
      pipeline_(device, {.name = "trace_cone.comp",
                         .spirv = k_trace_cone_comp,
                         .bindings = {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER,
                                      VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                      VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                         .pushConstantByteCount = sizeof(ConePush),
                         .specializationConstants = {/* LANES_PER_CONE= */ shape.lanesPerCone,
                                                     /* CONES_PER_WORKGROUP= */ shape.conesPerWorkgroup,
                                                     /* RAY_COUNT= */ rayCount,
                                                     /* ITERATION_LIMIT= */ shape.iterationLimit}}) {}

}  // namespace asdfvk
