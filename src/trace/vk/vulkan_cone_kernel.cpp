#include "trace/vk/vulkan_cone_kernel.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "asdf_vk/error.h"
#include "bvh/device_bvh.h"
#include "core/check.h"
#include "shared/cone_hit.h"
#include "shared/specialization_ids.h"
#include "spirv/cone_origins.comp.h"
#include "spirv/trace_packet.comp.h"
#include "spirv/trace_rays.comp.h"
#include "spirv/trace_reduce.comp.h"

namespace asdfvk {
namespace {

constexpr VkDescriptorType kTexels = VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;

VulkanTraceChoice choiceFor(const Device& device, const ConeKernelRequest& request) {
  return request.choice.value_or(defaultTraceChoice(device.facts()));
}

VkBool32 toBool32(bool value) { return value ? VK_TRUE : VK_FALSE; }

VkBool32 isCgal(const ConeKernelRequest& request) { return toBool32(request.definition == Definition::Cgal); }

ComputePipelineDescription describeReduction(const ConeKernelRequest& request) {
  return {.name = "trace_reduce.comp",
          .spirv = k_trace_reduce_comp,
          .bindings = {kTexels, kStorage, kStorage},
          .pushConstantByteCount = sizeof(ConePush),
          .specializationConstants = {{kLocalSizeXId, VulkanConeKernel::kReductionLaneCount},
                                      {kRayCountId, request.rayCount},
                                      {kIsCgalId, isCgal(request)}}};
}

ComputePipelineDescription describeOrigins(const VulkanTraceChoice& choice) {
  return {.name = "cone_origins.comp",
          .spirv = k_cone_origins_comp,
          .bindings = {kTexels, kTexels, kStorage, kStorage, kStorage, kStorage},
          .pushConstantByteCount = sizeof(ConePush),
          .specializationConstants = {{kLocalSizeXId, VulkanConeKernel::kOriginLaneCount},
                                      {kFetchesTexelsId, toBool32(choice.fetch == BvhFetch::Texel)}}};
}

struct RayShader {
  const char* name;
  std::span<const uint32_t> spirv;
};

RayShader shaderOf(TraceKernel kernel) {
  switch (kernel) {
    case TraceKernel::Packet:
      return {"trace_packet.comp", k_trace_packet_comp};
    case TraceKernel::Ray:
    case TraceKernel::Seed:
      break;
  }
  return {"trace_rays.comp", k_trace_rays_comp};
}

/// Returns the device. Throws if the device lacks subgroup operations of the kernel.
const Device& requireSubgroups(const Device& device, TraceKernel kernel) {
  const DeviceFacts& facts = device.facts();
  if (facts.hasSubgroupVote && (facts.hasSubgroupArithmetic || kernel != TraceKernel::Packet)) return device;
  throw Error(ErrorCode::KernelUnsupported,
              fmt::format("the compute shaders of {} have no subgroup {}, which the kernel needs", facts.name,
                          facts.hasSubgroupVote ? "arithmetic" : "vote"));
}

// Largest number of cones per chunk. A cone takes 48 bytes, so that a chunk takes 6 MiB.
constexpr uint64_t kMaxChunkConeCount = 1u << 17;
// Largest size of the hits of a chunk, sufficient for kMaxChunkConeCount cones of 30 rays.
constexpr uint64_t kMaxHitBufferByteCount = 32u << 20;
constexpr uint64_t kMaxLengthBufferByteCount = 16u << 20;

constexpr VkBufferUsageFlags kTexelUsage = VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
constexpr VkBufferUsageFlags kStorageUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

Buffer uploadRays(const Device& device, const Cone& cone) {
  std::vector<ConeRay> rays;
  for (size_t i = 0; i < cone.directions.size(); ++i)
    rays.push_back({toGlsl(cone.directions[i]), static_cast<float>(cone.weights[i])});
  return uploadBuffer(device, std::as_bytes(std::span(rays)), kTexelUsage);
}

bool fetchesTexels(const VulkanConeKernel& kernel) { return kernel.choice().fetch == BvhFetch::Texel; }

/// Usage of the buffers of the hierarchy. Throws Error{DeviceLimit} for a storage buffer that is too large.
VkBufferUsageFlags hierarchyUsage(const VulkanConeKernel& kernel, uint64_t byteCount) {
  if (fetchesTexels(kernel)) return kTexelUsage;
  requireStorageRange(kernel.device(), byteCount);
  return kStorageUsage;
}

Buffer uploadNodes(const VulkanConeKernel& kernel, const WideBvh& wide) {
  const auto bytes = std::as_bytes(std::span(wide.nodes));
  return uploadBuffer(kernel.device(), bytes, hierarchyUsage(kernel, bytes.size()));
}

Buffer uploadTriangles(const VulkanConeKernel& kernel, const TraceScene& scene, const WideBvh& wide) {
  const std::span<const uint32_t> faces = wide.primitiveFaces;
  return uploadItems<DeviceTriangle>(
      kernel.device(), faces.size(), hierarchyUsage(kernel, faces.size() * sizeof(DeviceTriangle)),
      [&](size_t first, std::span<DeviceTriangle> triangles) {
        encodeTriangles(scene.bvh, scene.mesh, scene.geometry, faces.subspan(first), triangles);
      });
}

uint64_t hitByteCount(const VulkanConeKernel& kernel) { return kernel.rayCount() * sizeof(ConeHit); }

}  // namespace

ComputePipelineDescription describeRays(const ConeKernelRequest& request, const VulkanTraceChoice& choice,
                                        const VulkanWorkgroupShape& shape, const VulkanWalkShape& walk) {
  const RayShader shader = shaderOf(choice.kernel);
  return {.name = shader.name,
          .spirv = shader.spirv,
          .bindings = {kTexels, kTexels, kStorage, kStorage, kTexels, kTexels, kStorage, kStorage},
          .pushConstantByteCount = sizeof(ConePush),
          .specializationConstants = {{kLocalSizeXId, shape.lanesPerCone * shape.conesPerWorkgroup},
                                      {kLanesPerConeId, shape.lanesPerCone},
                                      {kConesPerWorkgroupId, shape.conesPerWorkgroup},
                                      {kRayCountId, request.rayCount},
                                      {kIterationLimitId, shape.iterationLimit},
                                      {kWritesHitsId, toBool32(request.writesHits)},
                                      {kFetchesTexelsId, toBool32(choice.fetch == BvhFetch::Texel)},
                                      {kIsCgalId, isCgal(request)},
                                      {kStackSizeId, walk.stackSize},
                                      {kPostponesTrianglesId, toBool32(walk.postponesTriangles)},
                                      {kNodeArithmeticId, static_cast<uint32_t>(walk.arithmetic)}},
          .requiredSubgroupSize = walk.subgroupSize};
}

VulkanConeKernel::VulkanConeKernel(const Device& device, const ConeKernelRequest& request,
                                   const std::optional<VulkanWorkgroupShape>& shape,
                                   const std::optional<VulkanWalkShape>& walk)
    : device_(requireSubgroups(device, choiceFor(device, request).kernel)),
      request_(request),
      choice_(choiceFor(device, request)),
      shape_(shape.value_or(workgroupShapeFor(device.facts(), request.rayCount, choice_.kernel))),
      walk_(walk.value_or(walkShapeFor(device.facts()))),
      rays_(device, describeRays(request_, choice_, shape_, walk_)),
      reduction_(device, describeReduction(request_)) {
  if (request.definition == Definition::Paper) origins_.emplace(device, describeOrigins(choice_));
}

const ComputePipeline& VulkanConeKernel::rays(uint32_t depth) const {
  ASDFVK_CHECK_OP(depth, <=, kMaxBvhDepth);
  if (depth <= walk_.stackSize || choice_.kernel == TraceKernel::Packet) return rays_;
  std::call_once(isDeepMade_, [this] {
    VulkanWalkShape deep = walk_;
    deep.stackSize = kMaxBvhDepth;
    deepRays_.emplace(device_, describeRays(request_, choice_, shape_, deep));
  });
  return *deepRays_;
}

uint64_t largestConeChunk(const VulkanConeKernel& kernel) {
  const DeviceFacts& facts = kernel.device().facts();
  uint64_t largest =
      std::min({kMaxChunkConeCount, uint64_t{facts.maxWorkgroupCount} * kernel.shape().conesPerWorkgroup,
                facts.maxStorageBufferRange / sizeof(uint32_t), facts.maxTexelBufferElements / kConeOriginTexelCount});
  const auto boundBy = [&](uint64_t byteCount, uint64_t byteCountPerCone) {
    largest = std::min(largest, std::min(byteCount, facts.maxStorageBufferRange) / byteCountPerCone);
  };
  boundBy(kMaxLengthBufferByteCount, kernel.rayCount() * sizeof(uint32_t));
  if (kernel.writesHits()) boundBy(kMaxHitBufferByteCount, hitByteCount(kernel));
  return largest;
}

ConeBuffers::ConeBuffers(const VulkanConeKernel& kernel, const TraceScene& scene, const WideBvh& wide, const Cone& cone)
    : fetchesTexels_(fetchesTexels(kernel)),
      hierarchyDepth_(wide.depth),
      nodes_(uploadNodes(kernel, wide)),
      triangles_(uploadTriangles(kernel, scene, wide)),
      rays_(uploadRays(kernel.device(), cone)),
      nothing_(kernel.device(), 16, kTexelUsage | kStorageUsage, MemoryKind::DeviceLocal),
      nodeTexels_(kernel.device(), fetchesTexels_ ? nodes_ : nothing_),
      triangleTexels_(kernel.device(), fetchesTexels_ ? triangles_ : nothing_),
      rayTexels_(kernel.device(), rays_) {}

std::vector<Binding> ConeBuffers::hierarchyBindings() const {
  return {nodeTexels_, triangleTexels_, fetchesTexels_ ? nothing_ : nodes_, fetchesTexels_ ? nothing_ : triangles_};
}

}  // namespace asdfvk
