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
/// No new seed is nearer than some radius r to another or to an existing one, and no candidate of a component with a
/// seed is farther than (1 + 1/64) r from all. So they cover the candidates within 2 (1 + 1/64) times the least radius
/// that so many seeds need (Gonzalez, see farthest_point.h).
///
/// existing: faces already chosen, in any order; the new ones fill the gaps between them. Ascending; the same for the
/// same input and randomSeed.
[[nodiscard]] std::vector<uint32_t> blueNoiseSeeds(const SeedDomain& domain, SurfaceMetric metric, uint64_t count,
                                                   std::span<const uint32_t> existing, uint64_t randomSeed);

/// The same with more seeds where the density is higher: in the metric of hops about density(f) per face, in another
/// one on top of what the metric makes of the face. On smooth meshes it comes out within a tenth or two up to a tenth
/// of all faces; above that, less than asked for, as the dense parts fill up. Distances at a face are
/// stretched by the root of its density, so that seeds there are in proportion to density(f)^-1/2 apart.
///
/// density: #F, positive and finite, in any unit.
[[nodiscard]] std::vector<uint32_t> weightedBlueNoiseSeeds(const SeedDomain& domain, SurfaceMetric metric,
                                                           std::span<const double> density, uint64_t count,
                                                           std::span<const uint32_t> existing, uint64_t randomSeed);

}  // namespace asdfvk
