#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/traced_seeds.h"
#include "vk/buffer.h"
#include "vk/device.h"

namespace asdfvk {

/// Hits in the memory of a device, in one storage buffer.
class VulkanHitStore final : public HitStore {
 public:
  VulkanHitStore(const Device& device, uint32_t rayCount) : device_(device), rayCount_(rayCount) {}

  void reserve(size_t furtherSeedCount) override;
  void append(std::span<const ConeHit> hits) override;
  [[nodiscard]] std::vector<ConeHit> download() const override;

  [[nodiscard]] size_t seedCount() const { return hitCount_ / rayCount_; }
  /// Replaced by reserve() and append(). Precondition: one of them was called.
  [[nodiscard]] const Buffer& buffer() const { return hits_; }

 private:
  const Device& device_;
  uint32_t rayCount_;
  size_t hitCount_ = 0, capacity_ = 0;
  Buffer hits_, staging_;
};

}  // namespace asdfvk
