#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/seed_domain.h"
#include "seeds/surface_metric.h"

namespace asdfvk {

/// Poisson-disk seeds on the dual graph, exactly `count` of them or all candidates that are left: random, but none near
/// another nor near an existing one. See throwDarts(); the first radius is somewhat more than the estimated one.
///
/// Of all new seeds the last radius r is the least distance from any earlier one, and every candidate is nearer than
/// 9/8 r to some seed, or the next step's radius: within 2.25 times the least radius at which so many seeds can cover
/// the candidates, by Gonzalez's argument ("Clustering to minimize the maximum intercluster distance", 1985).
///
/// existing: faces already chosen, in any order; the new ones fill the gaps between them. Ascending; the same for the
/// same input and randomSeed.
[[nodiscard]] std::vector<uint32_t> blueNoiseSeeds(const SeedDomain& domain, SurfaceMetric metric, uint64_t count,
                                                   std::span<const uint32_t> existing, uint64_t randomSeed);

/// The same with more seeds where the density is higher: about density(f) to a face, as the metric counts faces.
/// density: #F, positive and finite, in any unit. Distances at a face are stretched by the root of its density, so that
/// seeds there are density(f)^-1/2 apart.
[[nodiscard]] std::vector<uint32_t> weightedBlueNoiseSeeds(const SeedDomain& domain, SurfaceMetric metric,
                                                           std::span<const double> density, uint64_t count,
                                                           std::span<const uint32_t> existing, uint64_t randomSeed);

}  // namespace asdfvk
