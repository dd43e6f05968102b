#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
  /// The hits of all seeds. Throws Error of kind Device.
  [[nodiscard]] virtual std::vector<ConeHit> download() const = 0;
  /// Frees the memory; no seed is left.
  virtual void release() = 0;
  /// For tracers of Vulkan.
  [[nodiscard]] virtual VulkanHitStore* onVulkan() = 0;
};

/// A view of the hits of all rays of some seeds.
struct SeedHitsView {
  std::span<const uint32_t> seeds;  ///< #S faces; kNoFace: this seed and its hits are ignored.
  std::span<const ConeHit> hits;    ///< #S x rays, see ConeResults::hits; empty where they are in a HitStore.

  [[nodiscard]] std::span<const ConeHit> of(uint32_t seed) const {
    const size_t rayCount = seeds.empty() ? 0 : hits.size() / seeds.size();
    return hits.subspan(seed * rayCount, rayCount);
  }
};

/// Owns the hits of all seeds of a computation in the order in which they are traced: on the host, in a HitStore, or,
/// where nothing reads them, nowhere.
class SeedHits {
 public:
  /// rayCount: rays of a seed; 0 where hits are not kept.
  explicit SeedHits(size_t rayCount) : rayCount_(rayCount) {}

  [[nodiscard]] bool areKept() const { return rayCount_ != 0; }
  /// Further hits are kept in the store; null: on the host. Precondition: there is no hit yet.
  void keepIn(HitStore* store) { store_ = store; }
  /// Memory for further seeds, so that growing does not copy the hits, which are most of the memory. All hits move to
  /// the host where the memory of the store does not suffice.
  void reserve(size_t furtherSeedCount);
  /// What a tracer writes for further seeds: these values, and hits of theirs.
  [[nodiscard]] ConeResults resultsFor(std::span<double> values);
  /// Afterwards the store has no hit and is not used. Throws Error of kind Device.
  void moveToHost();
  /// #S x rays; empty where they are in a store.
  [[nodiscard]] std::span<const ConeHit> onHost() const { return hits_; }

 private:
  size_t rayCount_;
  std::vector<ConeHit> hits_;
  HitStore* store_ = nullptr;
};

}  // namespace asdfvk
