#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/seed_hits.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// The compiled shaders/store_hits.comp for one device; serves any number of stores.
struct VulkanHitStoreKernel {
  explicit VulkanHitStoreKernel(const Device& theDevice);

  const Device& device;
  ComputePipeline pipeline;
};

/// Hits in the memory of a device, in one storage buffer. A trace on that device writes them with kernels.
class VulkanHitStore final : public HitStore {
 public:
  /// The kernel must outlive it.
  VulkanHitStore(const VulkanHitStoreKernel& kernel, uint32_t rayCount) : kernel_(kernel), rayCount_(rayCount) {}

  void reserve(size_t furtherSeedCount) override;
  [[nodiscard]] std::vector<ConeHit> download() const override;
  void release() override;
  [[nodiscard]] VulkanHitStore* onVulkan() override { return this; }

  [[nodiscard]] const Device& device() const { return kernel_.device; }
  [[nodiscard]] uint32_t rayCount() const { return rayCount_; }
  [[nodiscard]] size_t seedCount() const { return hitCount_ / rayCount_; }
  /// Further seeds whose memory is reserved.
  [[nodiscard]] size_t reservedCount() const { return (capacity_ - hitCount_) / rayCount_; }
  /// Replaced by reserve(). Precondition: it was called.
  [[nodiscard]] const Buffer& buffer() const { return hits_; }

  // The hits of a batch of seeds are written in any order before addSeeds() adds all of them.

  /// shaders/store_hits.comp and its buffers. hits: those of cone i start at i times the number of rays. places: the
  /// place of each cone in the batch.
  [[nodiscard]] const ComputePipeline& pipeline() const { return kernel_.pipeline; }
  [[nodiscard]] std::array<Binding, 3> bindings(const Buffer& hits, const Buffer& places) const {
    return {hits, places, hits_};
  }
  /// Records the copy of the hits of `coneCount` cones to their places. The caller records the barriers.
  void recordWrite(CommandList& commands, const BindingSet& bound, uint32_t coneCount) const;
  /// Writes hits of the host. places: #C, hits: #C x rays, at most DeviceFacts::maxStorageBufferRange bytes.
  void write(std::span<const uint32_t> places, std::span<const ConeHit> hits) const;
  /// Precondition: count <= reservedCount().
  void addSeeds(size_t count);

 private:
  const VulkanHitStoreKernel& kernel_;
  uint32_t rayCount_;
  size_t hitCount_ = 0, capacity_ = 0;
  Buffer hits_;
};

}  // namespace asdfvk
