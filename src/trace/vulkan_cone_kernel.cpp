#include "trace/vulkan_cone_kernel.h"

#include "shared/cone_layout.h"
#include "spirv/trace_cone.comp.h"

namespace asdfvk {

VulkanConeKernel::VulkanConeKernel(const Device& device, const ConeKernelRequest& request)
    : VulkanConeKernel(device, request, workgroupShapeFor(device.facts(), request.rayCount)) {}

VulkanConeKernel::VulkanConeKernel(const Device& device, const ConeKernelRequest& request,
                                   const VulkanWorkgroupShape& shape)
    : device_(device),
      request_(request),
      shape_(shape),
      pipeline_(device, {.name = "trace_cone.comp",
                         .spirv = k_trace_cone_comp,
                         .bindings = {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER,
                                      VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                      VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                         .pushConstantByteCount = sizeof(ConePush),
                         .specializationConstants = {/* LANES_PER_CONE= */ shape.lanesPerCone,
                                                     /* CONES_PER_WORKGROUP= */ shape.conesPerWorkgroup,
                                                     /* RAY_COUNT= */ request.rayCount,
                                                     /* ITERATION_LIMIT= */ shape.iterationLimit,
                                                     /* WRITES_HITS= */ request.writesHits ? VK_TRUE : VK_FALSE}}) {}

}  // namespace asdfvk
