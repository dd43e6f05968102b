#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/device_hits.h"
#include "trace/vk/device_seeds.h"
#include "vk/buffer.h"
#include "vk/command_list.h"

namespace asdfvk {

/// Hits in one buffer, in the order in which the device traces the cones, not in that of the cones.
class VulkanHits final : public DeviceHits {
 public:
  VulkanHits(const Device& device, uint32_t rayCount)
      : device_(device), coneByteCount_(uint64_t{rayCount} * sizeof(ConeHit)) {}

  void reserve(size_t coneCount) override;
  void download(std::span<ConeHit> hits) const override;

  /// A storage buffer; exists after reserve().
  [[nodiscard]] const Buffer& buffer() const { return buffer_; }
  [[nodiscard]] size_t coneCount() const { return places_.size(); }
  /// The hits of a cone begin at its place times the number of rays.
  [[nodiscard]] uint32_t placeOf(size_t cone) const { return places_[cone]; }
  /// Gives further cones the next places, in this order. DeviceCone::index counts from the first of these cones.
  void add(std::span<const DeviceCone> cones);
  /// Records the copy of the hits of `count` cones to a place and those that follow.
  void recordCopy(CommandList& commands, const Buffer& from, size_t place, size_t count) const;
  /// Writes the hits of cones that the host traced. cones: counted from the cone `first`. Waits for the device.
  void write(size_t first, std::span<const uint32_t> cones, std::span<const ConeHit> hits);

 private:
  const Device& device_;
  uint64_t coneByteCount_;
  Buffer buffer_;
  std::vector<uint32_t> places_;  // By cone.
};

}  // namespace asdfvk
