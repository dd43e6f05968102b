#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/seed_domain.h"
#include "seeds/surface_metric.h"

namespace asdfvk {

/// How the faces that cast rays are chosen; each has a header of its own.
enum class SamplerKind {
  Random,         ///< random_permutation.h, the paper's.
  DepthFirst,     ///< depth_first.h
  BlueNoise,      ///< blue_noise.h
  FarthestPoint,  ///< farthest_point.h
  NormalSpace,    ///< normal_space.h
};

/// Exactly `count` new faces out of the candidates, or all that are left; none of `existing` (faces already chosen, in
/// any order), between which they fill the gaps where the sampler has a notion of one. Ascending; the same for the same
/// input and randomSeed on any number of threads. The metric matters to BlueNoise and FarthestPoint only.
/// A connected component may be left without a seed, where there are fewer seeds than components certainly.
[[nodiscard]] std::vector<uint32_t> sampleSeeds(SamplerKind kind, SurfaceMetric metric, const SeedDomain& domain,
                                                uint64_t count, std::span<const uint32_t> existing,
                                                uint64_t randomSeed);

}  // namespace asdfvk
