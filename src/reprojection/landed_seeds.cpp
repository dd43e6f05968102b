#include "reprojection/landed_seeds.h"

namespace asdfvk {

Buckets<uint32_t> landedSeeds(const Cone& cone, const TraceScene& scene, const TracedCones& traced,
                              std::span<const LengthWindow> windows, const SeedCells& cells) {
  const size_t rayCount = cone.directions.size();
  return withoutRepeats(
      sortIntoBuckets<uint32_t>(traced.seeds.size(), traced.seeds.size(), [&](uint32_t seed, const auto& put) {
        for (const ConeHit& hit : traced.hits.subspan(seed * rayCount, rayCount)) {
          if (!isValidHit(scene, cone, traced.seeds[seed], hit)) continue;
          const uint32_t cell = cells.cellOf[hit.face];
          const bool isKept = windows[seed].keeps(static_cast<double>(hit.distance));
          if (cell != kNoCell && cell != seed && isKept) put(cell, seed);
        }
      }));
}

}  // namespace asdfvk
