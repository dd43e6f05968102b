#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/options.h"
#include "pipeline/prepared_mesh.h"
#include "seeds/samplers.h"

namespace asdfvk {

/// How many of the faces that can cast rays are asked for; at least one where there is any.
[[nodiscard]] uint64_t resolveSeedCount(const SeedCount& request, uint64_t castableFaceCount);

/// Seeds of two kinds: those that the sampler places, and probes, which are chosen at random among the other faces, so
/// that what is interpolated from the first can be judged at the second without bias.
struct SeedChoice {
  std::vector<uint32_t> placed, probes;  ///< Ascending; none is in both.
};

/// The sampler of the options. Throws Error{UnknownName}.
[[nodiscard]] const Sampler& requireSampler(const std::string& name);

/// How `count` further seeds are shared out when the error is to be estimated.
struct SeedShares {
  uint64_t placed = 0, probes = 0;
  uint64_t scouts = 0;  ///< For faces whose predicted values are the greatest, see chooseScouts().
};

/// earlierProbeCount: of the rounds before. predicts: scouts can be chosen.
[[nodiscard]] SeedShares shareOut(uint64_t count, uint64_t earlierProbeCount, bool predicts);

/// Chooses further placed seeds, and probes that any of the other faces is as likely to be. Where a prediction tells
/// more of these, no probes are asked for here: see chooseProbes(). earlier: what was chosen before. weight: #F, how
/// densely the faces deserve seeds, for the second half of an adaptive sampler's; or empty.
[[nodiscard]] SeedChoice chooseSeeds(const PreparedMesh& prepared, const Options& options, const SeedShares& shares,
                                     const SeedChoice& earlier, std::span<const double> weight);

/// The candidates with the greatest predictions that are no seeds yet, ascending. The range of the function, over which
/// errors are told, ends at a few faces that a sample of seeds misses; tracing these finds nearly all of it.
/// prediction, isSeed: #F.
[[nodiscard]] std::vector<uint32_t> chooseScouts(const PreparedMesh& prepared, std::span<const double> prediction,
                                                 std::span<const uint8_t> isSeed, uint64_t count);

}  // namespace asdfvk
