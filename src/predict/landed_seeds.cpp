#include "predict/landed_seeds.h"

namespace asdfvk {

Buckets<uint32_t> landedSeeds(const Cone& cone, const TraceScene& scene, const TracedCones& traced,
                              const SeedCells& cells) {
  std::vector<LengthWindow> windows(traced.seeds.size());
  forEachInParallel(windows.size(), [&](uint32_t seed) {
    if (traced.seeds[seed] != kNoFace) windows[seed] = keptLengths(scene, cone, traced, seed);
  });
  return withoutRepeats(
      sortIntoBuckets<uint32_t>(traced.seeds.size(), traced.seeds.size(), [&](uint32_t seed, const auto& put) {
        if (traced.seeds[seed] == kNoFace) return;
        for (const ConeHit& hit : traced.hitsOf(seed)) {
          if (!isValidHit(scene, cone, traced.seeds[seed], hit)) continue;
          const uint32_t cell = cells.cellOf[hit.face];
          const bool isKept = windows[seed].keeps(static_cast<double>(hit.distance));
          if (cell != kNoCell && cell != seed && isKept) put(cell, seed);
        }
      }));
}

}  // namespace asdfvk
