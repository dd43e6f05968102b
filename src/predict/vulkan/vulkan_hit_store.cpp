#include "predict/vulkan/vulkan_hit_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

void copy(const Device& device, const Buffer& from, const Buffer& to, uint64_t toOffset, uint64_t byteCount) {
  CommandList commands(device);
  commands.begin();
  commands.copy(from, 0, to, toOffset, byteCount);
  commands.barrier();
  commands.submitAndWait();
}

}  // namespace

void VulkanHitStore::reserve(size_t furtherSeedCount) {
  const size_t needed = hitCount_ + furtherSeedCount * rayCount_;
  if (needed <= capacity_) return;
  const uint64_t largest = device_.facts().maxStorageBufferRange / sizeof(ConeHit);
  if (needed > largest)
    throw Error(ErrorCode::DeviceLimit, fmt::format("{} hits are too many for a buffer of {}, which allows {}", needed,
                                                    device_.facts().name, largest));
  // Grows by a share, so that many small additions copy little.
  const size_t capacity = std::min<size_t>(largest, std::max(needed, capacity_ + capacity_ / 4));
  Buffer hits(device_, std::max<uint64_t>(16, capacity * sizeof(ConeHit)), kUsage, MemoryKind::DeviceLocal);
  if (hitCount_ > 0) copy(device_, hits_, hits, 0, hitCount_ * sizeof(ConeHit));
  hits_ = std::move(hits);
  capacity_ = capacity;
}

void VulkanHitStore::append(std::span<const ConeHit> hits) {
  ASDFVK_CHECK_OP(hits.size() % rayCount_, ==, size_t{0});
  if (hits.empty()) return;
  reserve(hits.size() / rayCount_);
  const uint64_t offset = hitCount_ * sizeof(ConeHit);
  if (hits_.mapped() != nullptr) {
    std::memcpy(hits_.mapped() + offset, hits.data(), hits.size_bytes());
  } else {
    if (staging_.byteCount() < hits.size_bytes())
      staging_ = Buffer(device_, hits.size_bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::HostVisible);
    std::memcpy(staging_.mapped(), hits.data(), hits.size_bytes());
    copy(device_, staging_, hits_, offset, hits.size_bytes());
  }
  hitCount_ += hits.size();
}

std::vector<ConeHit> VulkanHitStore::download() const {
  std::vector<ConeHit> hits(hitCount_);
  if (hitCount_ > 0) downloadBuffer(device_, hits_, std::as_writable_bytes(std::span(hits)));
  return hits;
}

}  // namespace asdfvk
