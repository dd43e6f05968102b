#include "trace/vulkan_cone_buffers.h"

#include <algorithm>
#include <vector>

#include "shared/cone_hit.h"

namespace asdfvk {
namespace {

// A chunk's cones need 48 bytes each; this many keep it at 6 MiB.
constexpr uint64_t kLargestChunk = 1u << 17;
// What hits of a chunk may need: at 30 rays as many cones.
constexpr uint64_t kLargestHitBufferByteCount = 32u << 20;

std::vector<ConeRay> deviceRays(const Cone& cone) {
  std::vector<ConeRay> rays;
  for (size_t i = 0; i < cone.directions.size(); ++i)
    rays.push_back({toGlsl(cone.directions[i]), static_cast<float>(cone.weights[i])});
  return rays;
}

template <typename T>
Buffer upload(const Device& device, const std::vector<T>& items, VkBufferUsageFlags usage) {
  return uploadBuffer(device, std::as_bytes(std::span(items)), usage);
}

/// Of one cone.
uint64_t hitByteCount(const VulkanConeKernel& kernel) { return kernel.rayCount() * sizeof(ConeHit); }

/// One cone's where there are none, as every binding needs a buffer.
uint64_t hitBufferByteCount(const VulkanConeKernel& kernel) {
  return (kernel.writesHits() ? largestConeChunk(kernel) : 1) * hitByteCount(kernel);
}

}  // namespace

uint64_t largestConeChunk(const VulkanConeKernel& kernel) {
  const DeviceFacts& facts = kernel.device().facts();
  const uint64_t largest =
      std::min({kLargestChunk, uint64_t{facts.maxWorkgroupCount} * kernel.shape().conesPerWorkgroup,
                facts.maxStorageBufferRange / sizeof(ConeOrigin)});
  if (!kernel.writesHits()) return largest;
  return std::min(largest, std::min(kLargestHitBufferByteCount, facts.maxStorageBufferRange) / hitByteCount(kernel));
}

ConeBuffers::ConeBuffers(const VulkanConeKernel& kernel, const DeviceBvh& bvh, const Cone& cone)
    : nodes(upload(kernel.device(), bvh.nodes, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT)),
      triangles(upload(kernel.device(), bvh.triangles, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT)),
      nodeTexels(kernel.device(), nodes),
      triangleTexels(kernel.device(), triangles),
      rays(upload(kernel.device(), deviceRays(cone), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)),
      origins(kernel.device(), largestConeChunk(kernel) * sizeof(ConeOrigin), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
              MemoryKind::HostVisible),
      results(kernel.device(), largestConeChunk(kernel) * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
              MemoryKind::HostVisible),
      hits(kernel.device(), hitBufferByteCount(kernel), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::HostVisible),
      bindings(kernel.device(), kernel.pipeline(),
               std::vector<Binding>{nodeTexels, triangleTexels, rays, origins, results, hits}) {}

}  // namespace asdfvk
