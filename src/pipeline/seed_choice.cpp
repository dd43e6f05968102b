#include "pipeline/seed_choice.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "seeds/blue_noise.h"
#include "seeds/random_permutation.h"

namespace asdfvk {
namespace {

// Keeps the probes independent of the placed seeds of the same number.
constexpr uint64_t kProbeStream = 0x7072'6f62'6500'0000u;

constexpr uint64_t kPlacedPerProbe = 3;
constexpr uint64_t kMostProbes = 400;

std::vector<uint32_t> without(std::span<const uint32_t> faces, std::span<const uint32_t> removed) {
  std::vector<uint32_t> rest;
  std::set_difference(faces.begin(), faces.end(), removed.begin(), removed.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

uint64_t resolveSeedCount(const SeedCount& request, uint64_t castableFaceCount) {
  if (castableFaceCount == 0 || request.kind == SeedCount::Kind::All) return castableFaceCount;
  if (request.kind == SeedCount::Kind::Count) {
    if (request.count == 0) throw Error(ErrorKind::Usage, "no seeds were asked for; give a count, a percentage or all");
    return std::min(request.count, castableFaceCount);
  }
  if (!(request.share > 0 && request.share <= 1))
    throw Error(ErrorKind::Usage, "the share of seeds is out of range; give more than 0 % and at most 100 %");
  const double count = std::round(request.share * static_cast<double>(castableFaceCount));
  return std::clamp<uint64_t>(static_cast<uint64_t>(count), 1, castableFaceCount);
}

uint64_t probeCountFor(uint64_t count, uint64_t earlierProbeCount) {
  return std::min(count / (kPlacedPerProbe + 1), kMostProbes - std::min(kMostProbes, earlierProbeCount));
}

SeedChoice chooseSeeds(const PreparedMesh& prepared, const Options& options, uint64_t count, uint64_t probeCount,
                       const SeedChoice& earlier, std::span<const double> weight) {
  // Placed seeds keep away from each other and not from probes, which must be like any other face to them.
  const std::vector<uint32_t> candidates = without(prepared.castableFaces, earlier.probes);
  const SeedDomain domain{prepared.graph, prepared.geometry, candidates};
  SeedChoice choice;
  if (options.sampler == SamplerKind::Random) {
    // All are placed at random: any of them can be probes, and which seeds there are does not depend on an estimate.
    const std::vector<uint32_t> all =
        sampleSeeds(options.sampler, options.metric, domain, count, earlier.placed, options.randomSeed);
    choice.probes = randomPermutationSeeds(all, probeCount, options.randomSeed ^ kProbeStream);
    choice.placed = without(all, choice.probes);
    return choice;
  }
  choice.placed = weight.empty() ? sampleSeeds(options.sampler, options.metric, domain, count - probeCount,
                                               earlier.placed, options.randomSeed)
                                 : weightedBlueNoiseSeeds(domain, options.metric, weight, count - probeCount,
                                                          earlier.placed, options.randomSeed);
  const std::vector<uint32_t> rest = without(unchosenCandidates(domain, earlier.placed), choice.placed);
  choice.probes = randomPermutationSeeds(rest, probeCount, (options.randomSeed ^ kProbeStream) + earlier.probes.size());
  return choice;
}

}  // namespace asdfvk
