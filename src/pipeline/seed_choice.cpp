#include "pipeline/seed_choice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/parallel.h"
#include "estimate/held_out.h"
#include "seeds/random_permutation.h"

namespace asdfvk {
namespace {

// More held-out faces leave so few seeds for the prediction that the estimate becomes worse (bench/experiments.md).
constexpr uint64_t kSeedsPerHeldOut = 4, kMinHeldOut = 200, kSeedsPerFurtherHeldOut = 10, kMaxHeldOut = 2000;

constexpr uint64_t kSeedsPerExtreme = 25, kMinExtreme = 16, kMaxExtreme = 400;

std::vector<uint32_t> without(std::span<const uint32_t> faces, std::span<const uint32_t> removed) {
  std::vector<uint32_t> rest;
  std::set_difference(faces.begin(), faces.end(), removed.begin(), removed.end(), std::back_inserter(rest));
  return rest;
}

/// Sorts faces whose first part is usually sorted.
void sortRuns(std::vector<uint32_t>& faces) {
  const auto end = std::is_sorted_until(faces.begin(), faces.end());
  sortInParallel(end, faces.end());
  std::inplace_merge(faces.begin(), end, faces.end());
}

/// All seeds; those that are not held out are in `sampled`.
SeedChoice earlierChoice(const Seeds& seeds) {
  SeedChoice choice;
  for (size_t seed = 0; seed < seeds.size(); ++seed)
    (seeds.isHeldOut(seed) ? choice.heldOut : choice.sampled).push_back(seeds.nodes[seed]);
  sortRuns(choice.sampled);
  sortRuns(choice.heldOut);
  return choice;
}

}  // namespace

uint64_t resolveSeedCount(const Options& options, uint64_t traceableFaceCount) {
  const SeedCount& request = options.seeds;
  if (traceableFaceCount == 0 || request.kind == SeedCount::Kind::All) return traceableFaceCount;
  if (request.kind == SeedCount::Kind::Count) {
    if (request.count == 0) throw Error(ErrorCode::OptionOutOfRange, "a seed count of 0 is out of range (1 or more)");
    return std::min(request.count, traceableFaceCount);
  }
  const bool isAutomatic = request.kind == SeedCount::Kind::Automatic;
  const double share = isAutomatic ? kAutomaticSeedShare : request.share;
  if (!(share > 0 && share <= 1))
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("a seed share of {} % is out of range (more than 0, at most 100 %)", 100 * share));
  const auto count = static_cast<uint64_t>(std::round(share * static_cast<double>(traceableFaceCount)));
  const bool hasMinimum = isAutomatic && options.interpolation.guidance == Guidance::Prediction;
  return std::min(std::max(count, hasMinimum ? kMinAutomaticSeedCount : 1), traceableFaceCount);
}

SeedShares shareSeeds(uint64_t count, uint64_t earlierHeldOutCount, bool predicts) {
  SeedShares shares;
  const uint64_t wanted = std::min(kMinHeldOut + count / kSeedsPerFurtherHeldOut, kMaxHeldOut);
  shares.heldOut = std::min(count / kSeedsPerHeldOut, wanted - std::min(wanted, earlierHeldOutCount));
  if (predicts) shares.extreme = std::min(std::clamp(count / kSeedsPerExtreme, kMinExtreme, kMaxExtreme), count / 10);
  shares.sampled = count - shares.heldOut - shares.extreme;
  return shares;
}

SeedChoice chooseSeeds(const FaceDomain& domain, ArcAngles& arcAngles, const Options& options, const SeedShares& shares,
                       const Seeds& earlierSeeds, std::span<const double> density, const RunControl& stopOnly) {
  const SeedChoice earlier = earlierChoice(earlierSeeds);
  // Samplers keep a distance to earlier seeds but ignore held-out faces, which must be a random sample.
  std::vector<uint32_t> notHeldOut;
  if (!earlier.heldOut.empty()) notHeldOut = without(domain.traceable, earlier.heldOut);
  const SeedDomain candidates{domain.graph, domain.geometry, arcAngles,
                              earlier.heldOut.empty() ? domain.traceable : std::span(std::as_const(notHeldOut)),
                              stopOnly};
  const Sampler& sampler = samplerOf(options.sampler);
  SeedChoice choice;
  if (sampler.isUniform) {
    // All seeds are sampled at random, so that any of them can be held out. The seeds are then the same with and
    // without an estimate.
    const std::vector<uint32_t> all =
        sampler.sample(candidates, shares.sampled + shares.heldOut, earlier.sampled, options.randomSeed);
    choice.heldOut = randomPermutationSeeds(all, shares.heldOut, heldOutSeed(options.randomSeed, 0));
    choice.sampled = without(all, choice.heldOut);
    return choice;
  }
  ASDFVK_CHECK(density.empty() || sampler.refine);
  choice.sampled = density.empty()
                       ? sampler.sample(candidates, shares.sampled, earlier.sampled, options.randomSeed)
                       : sampler.refine(candidates, density, shares.sampled, earlier.sampled, options.randomSeed);
  const std::vector<uint32_t> rest = without(remainingCandidates(candidates, earlier.sampled), choice.sampled);
  choice.heldOut =
      randomPermutationSeeds(rest, shares.heldOut, heldOutSeed(options.randomSeed, earlier.heldOut.size()));
  return choice;
}

std::vector<uint32_t> extremeSeeds(std::span<const uint32_t> traceable, std::span<const double> prediction,
                                   std::span<const uint8_t> isSeed, uint64_t count) {
  std::vector<uint32_t> faces =
      selectInParallel(traceable, [&](uint32_t face) { return !isSeed[face] && std::isfinite(prediction[face]); });
  const auto end = faces.begin() + static_cast<std::ptrdiff_t>(std::min<uint64_t>(count, faces.size()));
  std::nth_element(faces.begin(), end, faces.end(), [&](uint32_t a, uint32_t b) {
    return prediction[a] != prediction[b] ? prediction[a] > prediction[b] : a < b;
  });
  faces.erase(end, faces.end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace asdfvk
