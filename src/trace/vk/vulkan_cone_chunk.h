#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "shared/cone_hit.h"
#include "shared/cone_layout.h"
#include "trace/vk/vulkan_cone_kernel.h"
#include "trace/vk/vulkan_hits.h"
#include "vk/command_list.h"
#include "vk/shared_buffer.h"

namespace asdfvk {

/// Memory and commands for one submission of cones: the host writes seeds() or starts(), submits, waits, and reads
/// results() and hits(). The destructor waits for the device and releases the memory.
class ConeChunk {
 public:
  /// capacity: number of cones, at most largestConeChunk(). All arguments must outlive this object.
  ConeChunk(const VulkanConeKernel& kernel, const ConeBuffers& scene, uint64_t capacity);
  ~ConeChunk() { commands_.finish(); }
  ConeChunk(const ConeChunk&) = delete;
  ConeChunk& operator=(const ConeChunk&) = delete;

  [[nodiscard]] uint64_t capacity() const { return capacity_; }
  /// The cones of a submission with Input::Seeds. Precondition: the kernel has origins().
  [[nodiscard]] std::span<ConeSeed> seeds() { return seeds_.mappedAs<ConeSeed>(); }
  /// The cones of a submission with Input::Starts.
  [[nodiscard]] std::span<ConeOrigin> starts() { return origins_.onHost<ConeOrigin>(); }

  enum class Input { Seeds, Starts };
  /// Where the hits go: to hits(), or to memory of the device, from a place on.
  struct HitTarget {
    bool isHost = false;
    const VulkanHits* onDevice = nullptr;
    size_t place = 0;
  };
  void submit(const ConePush& push, Input input, const HitTarget& hits);
  void wait() { commands_.wait(); }

  /// See shared/cone_layout.h.
  [[nodiscard]] std::span<const uint32_t> results() { return results_.onHost<uint32_t>(); }
  /// The hits of cone i begin at i times the number of rays.
  [[nodiscard]] std::span<const ConeHit> hits() { return hits_->onHost<ConeHit>(); }

 private:
  const VulkanConeKernel& kernel_;
  const ComputePipeline& rays_;
  uint64_t capacity_;
  Buffer seeds_;          // Mapped: kernels read each entry once. Exists if the kernel has origins().
  SharedBuffer origins_;  // A ConeOrigin per cone.
  Buffer lengths_;        // The bits of a float for each ray of each cone.
  SharedBuffer results_;
  std::optional<SharedBuffer> hits_;  // Exists if the kernel writes hits.
  TexelView originTexels_;
  BindingSet rayBindings_, reductionBindings_;
  std::optional<BindingSet> originBindings_;
  CommandList commands_;  // The last member is destroyed first; its destructor waits.
};

}  // namespace asdfvk
