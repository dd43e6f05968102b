#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/options.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// How many of the faces that can cast rays are asked for; at least one where there is any.
[[nodiscard]] uint64_t resolveSeedCount(const SeedCount& request, uint64_t castableFaceCount);

/// Seeds of two kinds: those that the sampler places, and probes, which are placed at random among the other faces, so
/// that what is interpolated from the first can be judged at the second without bias.
struct SeedChoice {
  std::vector<uint32_t> placed, probes;  ///< Ascending; none is in both.
};

/// Of `count` further seeds, how many are probes when the error is to be estimated: a quarter, and in all not more than
/// are good for an estimate to about 10 %.
[[nodiscard]] uint64_t probeCountFor(uint64_t count, uint64_t earlierProbeCount);

/// Chooses `count` further seeds, probeCount of them probes. earlier: what was chosen before. weight: #F, how densely
/// the faces deserve seeds, for a sampler that adapts; or empty.
[[nodiscard]] SeedChoice chooseSeeds(const PreparedMesh& prepared, const Options& options, uint64_t count,
                                     uint64_t probeCount, const SeedChoice& earlier, std::span<const double> weight);

}  // namespace asdfvk
