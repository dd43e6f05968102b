#include "trace/vk/vulkan_hits.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/parallel.h"
#include "core/unset_vector.h"

namespace asdfvk {
namespace {

constexpr VkBufferUsageFlags kHitUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

}  // namespace

void VulkanHits::reserve(size_t coneCount) {
  const uint64_t usedByteCount = places_.size() * coneByteCount_;
  uint64_t byteCount = std::max<uint64_t>(coneCount, 1) * coneByteCount_;
  if (byteCount <= buffer_.byteCount()) return;
  // Memory that turns out too small grows by an eighth, because few seeds are added many times.
  if (usedByteCount > 0) byteCount = std::max(byteCount, usedByteCount / 8 * 9);
  requireStorageRange(device_, byteCount);
  Buffer larger(device_, byteCount, kHitUsage, MemoryKind::DeviceLocal);
  if (usedByteCount > 0) {
    CommandList commands(device_);
    commands.begin();
    commands.copy(buffer_, 0, larger, 0, usedByteCount);
    commands.barrier();
    commands.submitAndWait();
  }
  buffer_ = std::move(larger);
}

void VulkanHits::download(std::span<ConeHit> hits) const {
  UnsetVector<ConeHit> byPlace(hits.size());
  downloadBuffer(device_, buffer_, std::as_writable_bytes(std::span(byPlace)));
  const size_t rayCount = coneByteCount_ / sizeof(ConeHit);
  forEachInParallel(places_.size(), [&](size_t cone) {
    std::copy_n(byPlace.begin() + static_cast<std::ptrdiff_t>(places_[cone] * rayCount), rayCount,
                hits.subspan(cone * rayCount).begin());
  });
}

void VulkanHits::add(std::span<const DeviceCone> cones) {
  const size_t first = places_.size();
  places_.resize(first + cones.size());
  forEachInParallel(cones.size(),
                    [&](size_t i) { places_[first + cones[i].index] = static_cast<uint32_t>(first + i); });
}

void VulkanHits::recordCopy(CommandList& commands, const Buffer& from, size_t place, size_t count) const {
  commands.copy(from, 0, buffer_, place * coneByteCount_, count * coneByteCount_);
}

void VulkanHits::write(size_t first, std::span<const uint32_t> cones, std::span<const ConeHit> hits) {
  if (cones.empty()) return;
  const Buffer staging(device_, hits.size_bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::HostVisible);
  std::memcpy(staging.mapped(), hits.data(), hits.size_bytes());
  CommandList commands(device_);
  commands.begin();
  for (size_t i = 0; i < cones.size(); ++i)
    commands.copy(staging, i * coneByteCount_, buffer_, places_[first + cones[i]] * coneByteCount_, coneByteCount_);
  commands.barrier();
  commands.submitAndWait();
}

}  // namespace asdfvk
