#include "trace/vulkan/vulkan_cone_chunk.h"

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

}  // namespace

ConeChunk::ConeChunk(const VulkanConeKernel& kernel, const ConeBuffers& scene, uint64_t capacity, const Timing& timing,
                     const VulkanHitStore* store)
    : kernel_(kernel),
      capacity_(capacity),
      timing_(timing),
      store_(store),
      origins_(kernel.device(), capacity * sizeof(ConeOrigin), kOriginUsage, SharedBuffer::Host::Writes),
      results_(kernel.device(), capacity * sizeof(uint32_t), kChunkUsage, SharedBuffer::Host::Reads),
      originTexels_(kernel.device(), origins_.onDevice()),
      commands_(kernel.device()) {
  const Device& device = kernel.device();
  const uint64_t rayCount = kernel.rayCount();
  if (kernel.writesHits())
    hits_.emplace(device, capacity * rayCount * sizeof(ConeHit), kChunkUsage, SharedBuffer::Host::Reads);
  if (kernel.reduction())
    lengths_ = PooledBuffer(device, capacity * rayCount * sizeof(uint32_t), kChunkUsage, MemoryKind::DeviceOnly);
  bindings_.emplace(device, kernel.pipeline(),
                    joined(scene.hierarchyBindings(),
                           {scene.rayTexels(), originTexels_, kernel.reduction() ? *lengths_ : results_.onDevice(),
                            hits_ ? hits_->onDevice() : scene.nothing()}));
  if (kernel.reduction())
    reductionBindings_.emplace(device, *kernel.reduction(),
                               std::vector<Binding>{scene.rayTexels(), *lengths_, results_.onDevice()});
  if (store != nullptr) {
    places_ = PooledBuffer(device, capacity * sizeof(uint32_t), kChunkUsage, MemoryKind::HostVisible);
    storeBindings_.emplace(device, store->pipeline(), store->bindings(hits_->onDevice(), *places_));
  }
  if (!kernel.origins()) return;
  seeds_ = PooledBuffer(device, capacity * sizeof(ConeSeed), kChunkUsage, MemoryKind::HostVisible);
  originBindings_.emplace(device, *kernel.origins(), joined(scene.hierarchyBindings(), {*seeds_, origins_.onDevice()}));
}

void ConeChunk::submit(const ConePush& push, Input input, bool readsHits) {
  const VulkanWorkgroupShape& shape = kernel_.shape();
  commands_.begin();
  timing_.timer.begin(commands_.handle(), timing_.slot);
  if (input == Input::Seeds)
    commands_.dispatch(*kernel_.origins(), *originBindings_, bytesOf(push),
                       groupCount(push.coneCount, VulkanConeKernel::kOriginLaneCount));
  else
    origins_.recordCopy(commands_, push.coneCount * sizeof(ConeOrigin));
  commands_.barrier();
  commands_.dispatch(kernel_.pipeline(), *bindings_, bytesOf(push), groupCount(push.coneCount, shape.conesPerWorkgroup),
                     kernel_.reduction() ? groupCount(kernel_.rayCount(), shape.lanesPerCone) : 1);
  commands_.barrier();
  if (kernel_.reduction()) {
    commands_.dispatch(*kernel_.reduction(), *reductionBindings_, bytesOf(push),
                       groupCount(push.coneCount, VulkanConeKernel::kReductionLaneCount));
    commands_.barrier();
  }
  if (store_ != nullptr) store_->recordWrite(commands_, *storeBindings_, push.coneCount);
  results_.recordCopy(commands_, push.coneCount * sizeof(uint32_t));
  if (readsHits) hits_->recordCopy(commands_, uint64_t{push.coneCount} * kernel_.rayCount() * sizeof(ConeHit));
  commands_.barrier();
  timing_.timer.end(commands_.handle(), timing_.slot);
  commands_.submit();
}

void ConeChunk::wait() {
  commands_.wait();
  timing_.timer.add(timing_.slot);
}

}  // namespace asdfvk
