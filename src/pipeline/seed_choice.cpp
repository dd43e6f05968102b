#include "pipeline/seed_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "estimate/held_out.h"

namespace asdfvk {
namespace {

// More probes than these leave so few seeds to predict from that the estimate is worse for it (docs/experiments.md).
constexpr uint64_t kSeedsPerProbe = 4, kEnoughProbes = 200, kSeedsPerFurtherProbe = 10, kMostProbes = 2000;

constexpr uint64_t kSeedsPerScout = 25, kLeastScouts = 16, kMostScouts = 400;

std::vector<uint32_t> without(std::span<const uint32_t> faces, std::span<const uint32_t> removed) {
  std::vector<uint32_t> rest;
  std::set_difference(faces.begin(), faces.end(), removed.begin(), removed.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

std::vector<std::string> samplerNames() {
  std::vector<std::string> names;
  for (const Sampler& sampler : kSamplers) names.emplace_back(sampler.name);
  return names;
}

const Sampler& requireSampler(const std::string& name) {
  if (const Sampler* sampler = findSampler(name)) return *sampler;
  throw Error(ErrorCode::UnknownName,
              fmt::format("'{}' is not a sampler; the samplers are {}", name, fmt::join(samplerNames(), ", ")),
              {{"name", name}});
}

uint64_t resolveSeedCount(const SeedCount& request, uint64_t castableFaceCount) {
  if (castableFaceCount == 0 || request.kind == SeedCount::Kind::All) return castableFaceCount;
  if (request.kind == SeedCount::Kind::Count) {
    if (request.count == 0)
      throw Error(ErrorCode::OptionOutOfRange, "no seeds were asked for; give a count, a percentage or all");
    return std::min(request.count, castableFaceCount);
  }
  if (!(request.share > 0 && request.share <= 1))
    throw Error(ErrorCode::OptionOutOfRange,
                "the share of seeds is out of range; give more than 0 % and at most 100 %");
  const double count = std::round(request.share * static_cast<double>(castableFaceCount));
  return std::clamp<uint64_t>(static_cast<uint64_t>(count), 1, castableFaceCount);
}

SeedShares shareOut(uint64_t count, uint64_t earlierProbeCount, bool predicts) {
  SeedShares shares;
  const uint64_t enough = std::min(kEnoughProbes + count / kSeedsPerFurtherProbe, kMostProbes);
  shares.probes = std::min(count / kSeedsPerProbe, enough - std::min(enough, earlierProbeCount));
  if (predicts) shares.scouts = std::min(std::clamp(count / kSeedsPerScout, kLeastScouts, kMostScouts), count / 10);
  shares.placed = count - shares.probes - shares.scouts;
  return shares;
}

SeedChoice chooseSeeds(const PreparedMesh& prepared, const Options& options, const SeedShares& shares,
                       const SeedChoice& earlier, std::span<const double> weight) {
  // Placed seeds keep away from each other and not from probes, which must be like any other face to them.
  std::vector<uint32_t> notProbes;
  if (!earlier.probes.empty()) notProbes = without(prepared.castableFaces, earlier.probes);
  const SeedDomain domain{
      prepared.graph, prepared.geometry,
      earlier.probes.empty() ? std::span(prepared.castableFaces) : std::span(std::as_const(notProbes))};
  const Sampler& sampler = requireSampler(options.sampler);
  SeedChoice choice;
  if (sampler.isUniform) {
    // All are placed at random: any of them can be probes, and the same faces are seeds without an estimate.
    const std::vector<uint32_t> all =
        sampler.sample(domain, shares.placed + shares.probes, earlier.placed, options.randomSeed);
    choice.probes = randomPermutationSeeds(all, shares.probes, probeSeed(options.randomSeed, 0));
    choice.placed = without(all, choice.probes);
    return choice;
  }
  ASDFVK_CHECK(weight.empty() || sampler.refine);
  choice.placed = weight.empty() ? sampler.sample(domain, shares.placed, earlier.placed, options.randomSeed)
                                 : sampler.refine(domain, weight, shares.placed, earlier.placed, options.randomSeed);
  const std::vector<uint32_t> rest = without(remainingCandidates(domain, earlier.placed), choice.placed);
  choice.probes = randomPermutationSeeds(rest, shares.probes, probeSeed(options.randomSeed, earlier.probes.size()));
  return choice;
}

std::vector<uint32_t> chooseScouts(const PreparedMesh& prepared, std::span<const double> prediction,
                                   std::span<const uint8_t> isSeed, uint64_t count) {
  std::vector<uint32_t> scouts;
  for (const uint32_t face : prepared.castableFaces)
    if (!isSeed[face] && std::isfinite(prediction[face])) scouts.push_back(face);
  const auto end = scouts.begin() + static_cast<std::ptrdiff_t>(std::min<uint64_t>(count, scouts.size()));
  std::nth_element(scouts.begin(), end, scouts.end(), [&](uint32_t a, uint32_t b) {
    return prediction[a] != prediction[b] ? prediction[a] > prediction[b] : a < b;
  });
  scouts.erase(end, scouts.end());
  std::sort(scouts.begin(), scouts.end());
  return scouts;
}

}  // namespace asdfvk
