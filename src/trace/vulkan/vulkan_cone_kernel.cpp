#include "trace/vulkan/vulkan_cone_kernel.h"

#include <fmt/format.h>

#include "asdf_vk/error.h"
#include "shared/cone_layout.h"
#include "spirv/trace_cone.comp.h"
#include "spirv/trace_packet.comp.h"
#include "spirv/trace_reduce.comp.h"
#include "spirv/trace_seed.comp.h"

namespace asdfvk {
namespace {

constexpr VkDescriptorType kTexels = VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;

VulkanTraceChoice choiceFor(const Device& device, const ConeKernelRequest& request) {
  return request.choice.value_or(defaultTraceChoice(device.facts()));
}

struct Shader {
  std::string name;
  std::span<const uint32_t> spirv;
};

Shader shaderOf(TraceKernel kernel) {
  if (kernel == TraceKernel::Packet) return {"trace_packet.comp", k_trace_packet_comp};
  if (kernel == TraceKernel::Ray) return {"trace_cone.comp", k_trace_cone_comp};
  return {"trace_seed.comp", k_trace_seed_comp};
}

ComputePipelineDescription describe(const ConeKernelRequest& request, const VulkanTraceChoice& choice,
                                    const VulkanWorkgroupShape& shape) {
  const Shader shader = shaderOf(choice.kernel);
  return {.name = shader.name,
          .spirv = shader.spirv,
          .bindings = {kTexels, kTexels, kStorage, kStorage, kTexels, kTexels, kStorage, kStorage},
          .pushConstantByteCount = sizeof(ConePush),
          .specializationConstants = {/* LANES_PER_CONE= */ shape.lanesPerCone,
                                      /* CONES_PER_WORKGROUP= */ shape.conesPerWorkgroup,
                                      /* RAY_COUNT= */ request.rayCount,
                                      /* ITERATION_LIMIT= */ shape.iterationLimit,
                                      /* WRITES_HITS= */ request.writesHits ? VK_TRUE : VK_FALSE,
                                      /* FETCHES_TEXELS= */ choice.fetch == BvhFetch::Texel ? VK_TRUE : VK_FALSE,
                                      /* IS_WIDE= */ choice.bvh == BvhLayout::Wide ? VK_TRUE : VK_FALSE,
                                      /* LANE_COUNT= */ shape.lanesPerCone * shape.conesPerWorkgroup}};
}

/// Returns the device, or throws.
const Device& requireSubgroups(const Device& device, TraceKernel kernel) {
  const DeviceFacts& facts = device.facts();
  if (facts.hasSubgroupVote && (facts.hasSubgroupArithmetic || kernel != TraceKernel::Packet)) return device;
  throw Error(ErrorCode::KernelUnsupported,
              fmt::format("the compute shaders of {} have no subgroup {}, which the kernel needs", facts.name,
                          facts.hasSubgroupVote ? "arithmetic" : "vote"));
}

}  // namespace

VulkanConeKernel::VulkanConeKernel(const Device& device, const ConeKernelRequest& request)
    : VulkanConeKernel(device, request,
                       workgroupShapeFor(device.facts(), request.rayCount, choiceFor(device, request).kernel)) {}

VulkanConeKernel::VulkanConeKernel(const Device& device, const ConeKernelRequest& request,
                                   const VulkanWorkgroupShape& shape)
    : device_(requireSubgroups(device, choiceFor(device, request).kernel)),
      request_(request),
      choice_(choiceFor(device, request)),
      shape_(shape),
      pipeline_(device, describe(request_, choice_, shape_)) {
  if (choice_.kernel == TraceKernel::Seed)
    reduction_.emplace(device,
                       ComputePipelineDescription{.name = "trace_reduce.comp",
                                                  .spirv = k_trace_reduce_comp,
                                                  .bindings = {kTexels, kStorage, kStorage},
                                                  .pushConstantByteCount = sizeof(ConePush),
                                                  .specializationConstants = {kReductionLaneCount, request.rayCount}});
}

}  // namespace asdfvk
