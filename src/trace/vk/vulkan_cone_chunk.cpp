#include "trace/vk/vulkan_cone_chunk.h"

#include <vector>

namespace asdfvk {
namespace {

constexpr VkBufferUsageFlags kChunkUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags kOriginUsage = kChunkUsage | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;

uint32_t groupCount(uint32_t count, uint32_t perGroup) { return (count + perGroup - 1) / perGroup; }

std::vector<Binding> joined(std::vector<Binding> first, const std::vector<Binding>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

uint64_t byteCountPerRay(const VulkanConeKernel& kernel, uint64_t capacity, size_t entryByteCount) {
  return capacity * kernel.rayCount() * entryByteCount;
}

std::optional<SharedBuffer> makeHits(const VulkanConeKernel& kernel, uint64_t capacity) {
  if (!kernel.writesHits()) return std::nullopt;
  return SharedBuffer(kernel.device(), byteCountPerRay(kernel, capacity, sizeof(ConeHit)), kChunkUsage,
                      SharedBuffer::Host::Reads);
}

}  // namespace

ConeChunk::ConeChunk(const VulkanConeKernel& kernel, const ConeBuffers& scene, uint64_t capacity)
    : kernel_(kernel),
      rays_(kernel.rays(scene.hierarchyDepth())),
      capacity_(capacity),
      origins_(kernel.device(), capacity * sizeof(ConeOrigin), kOriginUsage, SharedBuffer::Host::Writes),
      lengths_(kernel.device(), byteCountPerRay(kernel, capacity, sizeof(uint32_t)), kChunkUsage,
               MemoryKind::DeviceOnly),
      results_(kernel.device(), capacity * sizeof(uint32_t), kChunkUsage, SharedBuffer::Host::Reads),
      hits_(makeHits(kernel, capacity)),
      originTexels_(kernel.device(), origins_.onDevice()),
      rayBindings_(kernel.device(), rays_,
                   joined(scene.hierarchyBindings(),
                          {scene.rayTexels(), originTexels_, lengths_, hits_ ? hits_->onDevice() : scene.nothing()})),
      reductionBindings_(kernel.device(), kernel.reduction(),
                         std::vector<Binding>{scene.rayTexels(), lengths_, results_.onDevice()}),
      commands_(kernel.device()) {
  if (kernel.origins() == nullptr) return;
  seeds_ = Buffer(kernel.device(), capacity * sizeof(ConeSeed), kChunkUsage, MemoryKind::HostVisible);
  originBindings_.emplace(kernel.device(), *kernel.origins(),
                          joined(scene.hierarchyBindings(), {seeds_, origins_.onDevice()}));
}

void ConeChunk::submit(const ConePush& push, Input input, const HitTarget& hits) {
  const VulkanWorkgroupShape& shape = kernel_.shape();
  commands_.begin();
  if (input == Input::Seeds)
    commands_.dispatch(*kernel_.origins(), *originBindings_, bytesOf(push),
                       groupCount(push.coneCount, VulkanConeKernel::kOriginLaneCount));
  else
    origins_.recordCopy(commands_, push.coneCount * sizeof(ConeOrigin));
  commands_.barrier();
  commands_.dispatch(rays_, rayBindings_, bytesOf(push), groupCount(push.coneCount, shape.conesPerWorkgroup),
                     groupCount(kernel_.rayCount(), shape.lanesPerCone));
  commands_.barrier();
  commands_.dispatch(kernel_.reduction(), reductionBindings_, bytesOf(push),
                     groupCount(push.coneCount, VulkanConeKernel::kReductionLaneCount));
  commands_.barrier();
  results_.recordCopy(commands_, push.coneCount * sizeof(uint32_t));
  if (hits.isHost) hits_->recordCopy(commands_, byteCountPerRay(kernel_, push.coneCount, sizeof(ConeHit)));
  if (hits.onDevice != nullptr) hits.onDevice->recordCopy(commands_, hits_->onDevice(), hits.place, push.coneCount);
  commands_.barrier();
  commands_.submit();
}

}  // namespace asdfvk
