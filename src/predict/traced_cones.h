#pragma once

#include <cstdint>
#include <span>

#include "cone/cone.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// All rays of some seeds and what they met.
struct TracedCones {
  /// #S. kNoFace: this seed is left out, its hits are not looked at.
  std::span<const uint32_t> seeds;
  std::span<const ConeHit> hits;  ///< #S x rays, as ConeResults::hits.

  [[nodiscard]] std::span<const ConeHit> hitsOf(uint32_t seed) const {
    const size_t rayCount = seeds.empty() ? 0 : hits.size() / seeds.size();
    return hits.subspan(seed * rayCount, rayCount);
  }
};

/// Neither a miss nor a false intersection.
[[nodiscard]] bool isValidHit(const TraceScene& scene, const Cone& cone, uint32_t seedFace, const ConeHit& hit);

/// Which lengths the outlier rule of the cone of that seed keeps, in normalised units.
[[nodiscard]] LengthWindow keptLengths(const TraceScene& scene, const Cone& cone, const TracedCones& traced,
                                       uint32_t seed);

}  // namespace asdfvk
