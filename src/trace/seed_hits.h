#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "trace/cone_tracer.h"

namespace asdfvk {

struct SeedHitsView {
  std::span<const uint32_t> seeds;       ///< #S nodes; kNoFace: this seed and its hits are ignored.
  std::span<const ConeHit> hits;         ///< #S x rays, see ConeResults::hits.
  const DeviceHits* onDevice = nullptr;  ///< The hits; then `hits` is empty.

  /// Whether there is nothing to predict from.
  [[nodiscard]] bool isEmpty() const { return seeds.empty() || (hits.empty() && onDevice == nullptr); }
  [[nodiscard]] std::span<const ConeHit> of(uint32_t seed) const {
    const size_t rayCount = seeds.empty() ? 0 : hits.size() / seeds.size();
    return hits.subspan(seed * rayCount, rayCount);
  }
};

}  // namespace asdfvk
