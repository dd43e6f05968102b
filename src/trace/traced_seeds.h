#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

class VulkanHitStore;

/// Keeps the hits of seeds in the memory of a device, so that the host needs none for them. A tracer of that device
/// adds them: ConeResults::store.
class HitStore {
 public:
  virtual ~HitStore() = default;

  /// Memory for the hits of further seeds. Throws Error of kind Device, and then is as before.
  virtual void reserve(size_t furtherSeedCount) = 0;
  /// Of all seeds. Throws Error of kind Device.
  [[nodiscard]] virtual std::vector<ConeHit> download() const = 0;
  /// Frees the memory; no seed is left.
  virtual void release() = 0;
  /// For tracers of Vulkan.
  [[nodiscard]] virtual VulkanHitStore* onVulkan() = 0;
};

/// Seed faces and their results.
struct TracedSeeds {
  explicit TracedSeeds(size_t faceCount) : values(faceCount, kNoValue), isSeed(faceCount, 0) {}

  std::vector<double> values;   ///< #F; NaN where no ray was cast or no hit was valid.
  std::vector<uint8_t> isSeed;  ///< #F, 1 where rays were cast.
  std::vector<uint32_t> faces;  ///< #S, in the order in which they were traced.
  std::vector<ConeHit> hits;    ///< #S x rays, see ConeResults::hits; empty where hits are not kept, or in a HitStore.
  TraceStatistics statistics;
};

/// A view of the hits of all rays of some seeds.
struct SeedHits {
  std::span<const uint32_t> seeds;  ///< #S faces; kNoFace: this seed and its hits are ignored.
  std::span<const ConeHit> hits;    ///< #S x rays, as ConeResults::hits; empty where they are in a HitStore.

  [[nodiscard]] std::span<const ConeHit> of(uint32_t seed) const {
    const size_t rayCount = seeds.empty() ? 0 : hits.size() / seeds.size();
    return hits.subspan(seed * rayCount, rayCount);
  }
};

}  // namespace asdfvk
