#include "trace/vulkan/vulkan_cone_buffers.h"

#include <algorithm>
#include <vector>

#include "shared/cone_hit.h"

namespace asdfvk {
namespace {

// A chunk's cones need 48 bytes each; this many keep it at 6 MiB.
constexpr uint64_t kLargestChunk = 1u << 17;
// What hits of a chunk may need: at 30 rays as many cones.
constexpr uint64_t kLargestHitBufferByteCount = 32u << 20;
constexpr uint64_t kLargestLengthBufferByteCount = 16u << 20;

constexpr VkBufferUsageFlags kTexelUsage = VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
constexpr VkBufferUsageFlags kStorageUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

Buffer uploadRays(const Device& device, const Cone& cone) {
  std::vector<ConeRay> rays;
  for (size_t i = 0; i < cone.directions.size(); ++i)
    rays.push_back({toGlsl(cone.directions[i]), static_cast<float>(cone.weights[i])});
  return uploadBuffer(device, std::as_bytes(std::span(rays)), kTexelUsage);
}

bool fetchesTexels(const VulkanConeKernel& kernel) { return kernel.choice().fetch == BvhFetch::Texel; }

Buffer uploadHierarchy(const VulkanConeKernel& kernel, std::span<const std::byte> bytes) {
  return uploadBuffer(kernel.device(), bytes, fetchesTexels(kernel) ? kTexelUsage : kStorageUsage);
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
  uint64_t largest =
      std::min({kLargestChunk, uint64_t{facts.maxWorkgroupCount} * kernel.shape().conesPerWorkgroup,
                facts.maxStorageBufferRange / sizeof(uint32_t), facts.maxTexelBufferElements / kConeOriginTexelCount});
  const auto boundBy = [&](uint64_t byteCount, uint64_t byteCountPerCone) {
    largest = std::min(largest, std::min(byteCount, facts.maxStorageBufferRange) / byteCountPerCone);
  };
  if (kernel.reduction()) boundBy(kLargestLengthBufferByteCount, kernel.rayCount() * sizeof(uint32_t));
  if (kernel.writesHits()) boundBy(kLargestHitBufferByteCount, hitByteCount(kernel));
  return largest;
}

ConeBuffers::ConeBuffers(const VulkanConeKernel& kernel, const DeviceBvh& bvh, const Cone& cone)
    : nodes(uploadHierarchy(kernel, bvh.nodeBytes())),
      triangles(uploadHierarchy(kernel, std::as_bytes(std::span(bvh.triangles)))),
      rays(uploadRays(kernel.device(), cone)),
      origins(kernel.device(), largestConeChunk(kernel) * sizeof(ConeOrigin), kTexelUsage, MemoryKind::HostVisible),
      lengths(kernel.device(),
              kernel.reduction() ? largestConeChunk(kernel) * kernel.rayCount() * sizeof(uint32_t) : 16, kStorageUsage,
              MemoryKind::DeviceOnly),
      results(kernel.device(), largestConeChunk(kernel) * sizeof(uint32_t), kStorageUsage, MemoryKind::HostVisible),
      hits(kernel.device(), hitBufferByteCount(kernel), kStorageUsage, MemoryKind::HostVisible),
      nothing_(kernel.device(), 16, kTexelUsage | kStorageUsage, MemoryKind::DeviceLocal),
      nodeTexels_(kernel.device(), fetchesTexels(kernel) ? nodes : nothing_),
      triangleTexels_(kernel.device(), fetchesTexels(kernel) ? triangles : nothing_),
      rayTexels_(kernel.device(), rays),
      originTexels_(kernel.device(), origins),
      bindings(kernel.device(), kernel.pipeline(),
               std::vector<Binding>{nodeTexels_, triangleTexels_, fetchesTexels(kernel) ? nothing_ : nodes,
                                    fetchesTexels(kernel) ? nothing_ : triangles, rayTexels_, originTexels_,
                                    kernel.reduction() ? lengths : results, hits}) {
  if (kernel.reduction())
    reductionBindings.emplace(kernel.device(), *kernel.reduction(), std::vector<Binding>{rayTexels_, lengths, results});
}

}  // namespace asdfvk
