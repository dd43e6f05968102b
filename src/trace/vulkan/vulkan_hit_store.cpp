#include "trace/vulkan/vulkan_hit_store.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "spirv/store_hits.comp.h"
#include "vk/shared_buffer.h"

namespace asdfvk {
namespace {

constexpr uint32_t kStoreLaneCount = 64;
constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// The largest number of hits in one buffer.
uint64_t largestCount(const DeviceFacts& facts) {
  const uint64_t allocation = facts.maxMemoryAllocationSize > 0 ? facts.maxMemoryAllocationSize : UINT64_MAX;
  return std::min(facts.maxStorageBufferRange, allocation) / sizeof(ConeHit);
}

Buffer makeHits(const Device& device, size_t count) {
  return {device, std::max<uint64_t>(16, count * sizeof(ConeHit)), kUsage, MemoryKind::DeviceLocal};
}

}  // namespace

VulkanHitStoreKernel::VulkanHitStoreKernel(const Device& theDevice)
    : device(theDevice),
      pipeline(theDevice, {.name = "store_hits.comp",
                           .spirv = k_store_hits_comp,
                           .bindings = std::vector(3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
                           .pushConstantByteCount = sizeof(HitStorePush),
                           .specializationConstants = {/* LOCAL_SIZE_X= */ kStoreLaneCount}}) {}

void VulkanHitStore::reserve(size_t furtherSeedCount) {
  const size_t needed = hitCount_ + furtherSeedCount * rayCount_;
  if (needed <= capacity_) return;
  const uint64_t largest = largestCount(device().facts());
  if (needed > largest)
    throw Error(ErrorCode::DeviceLimit, fmt::format("{} hits are too many for a buffer of {}, which allows {}", needed,
                                                    device().facts().name, largest));
  if (hitCount_ == 0) release();  // Before the allocation: less memory at the peak.
  // Grows by a share, so that many small additions copy little.
  size_t capacity = std::min<size_t>(largest, std::max(needed, capacity_ + capacity_ / 4));
  Buffer hits;
  try {
    hits = makeHits(device(), capacity);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::OutOfDeviceMemory || capacity == needed) throw;
    capacity = needed;
    hits = makeHits(device(), capacity);
  }
  if (hitCount_ > 0) {
    CommandList commands(device());
    commands.begin();
    commands.copy(hits_, 0, hits, 0, hitCount_ * sizeof(ConeHit));
    commands.barrier();
    commands.submitAndWait();
  }
  hits_ = std::move(hits);
  capacity_ = capacity;
}

std::vector<ConeHit> VulkanHitStore::download() const {
  std::vector<ConeHit> hits(hitCount_);
  if (hitCount_ > 0) downloadBuffer(device(), hits_, std::as_writable_bytes(std::span(hits)));
  return hits;
}

void VulkanHitStore::release() {
  const Buffer freed = std::exchange(hits_, {});
  hitCount_ = capacity_ = 0;
}

void VulkanHitStore::recordWrite(CommandList& commands, const BindingSet& bound, uint32_t coneCount) const {
  const HitStorePush push{coneCount * rayCount_, rayCount_, static_cast<uint32_t>(seedCount())};
  constexpr uint32_t kPerWorkgroup = kStoreLaneCount * kStoredHitsPerLane;
  commands.dispatch(pipeline(), bound, bytesOf(push), (push.hitCount + kPerWorkgroup - 1) / kPerWorkgroup);
}

void VulkanHitStore::write(std::span<const uint32_t> places, std::span<const ConeHit> hits) const {
  ASDFVK_CHECK_OP(hits.size(), ==, places.size() * rayCount_);
  if (hits.empty()) return;
  constexpr VkBufferUsageFlags kInput = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  SharedBuffer placesOfCones(device(), places.size_bytes(), kInput, SharedBuffer::Host::Writes);
  SharedBuffer written(device(), hits.size_bytes(), kInput, SharedBuffer::Host::Writes);
  std::ranges::copy(places, placesOfCones.onHost<uint32_t>().begin());
  std::ranges::copy(hits, written.onHost<ConeHit>().begin());
  const BindingSet bound(device(), pipeline(), bindings(written.onDevice(), placesOfCones.onDevice()));
  CommandList commands(device());
  commands.begin();
  placesOfCones.recordCopy(commands, places.size_bytes());
  written.recordCopy(commands, hits.size_bytes());
  commands.barrier();
  recordWrite(commands, bound, static_cast<uint32_t>(places.size()));
  commands.barrier();
  commands.submitAndWait();
}

void VulkanHitStore::addSeeds(size_t count) {
  ASDFVK_CHECK_OP(count, <=, reservedCount());
  hitCount_ += count * rayCount_;
}

}  // namespace asdfvk
