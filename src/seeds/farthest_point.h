#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/seed_domain.h"
#include "seeds/surface_metric.h"

namespace asdfvk {

/// Farthest-point seeds: each is, of all candidates, one of the farthest from those before it and from the existing
/// ones (Gonzalez, "Clustering to minimize the maximum intercluster distance", 1985). Farthest up to a share of 1/64,
/// which keeps the search for it in constant time (see throwDarts()); so many seeds cover the candidates within a
/// radius of at most 2 (1 + 1/64) times the least. A component without a seed is farther than any distance.
/// Takes about log(count) times as long as blue noise, whose first seeds are random instead.
///
/// existing: faces already chosen, in any order. Exactly `count` seeds or all candidates that are left, ascending; the
/// random seed decides the first face and between equals.
[[nodiscard]] std::vector<uint32_t> farthestPointSeeds(const SeedDomain& domain, SurfaceMetric metric, uint64_t count,
                                                       std::span<const uint32_t> existing, uint64_t randomSeed);

}  // namespace asdfvk
