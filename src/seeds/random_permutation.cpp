#include "seeds/random_permutation.h"

#include <algorithm>

#include "core/random.h"
#include "seeds/samplers.h"

namespace asdfvk {

std::vector<uint32_t> randomSeeds(const SeedDomain& domain, uint64_t count, std::span<const uint32_t> existing,
                                  uint64_t randomSeed) {
  return randomPermutationSeeds(remainingCandidates(domain, existing), count, randomSeed);
}

std::vector<uint32_t> randomPermutationSeeds(std::span<const uint32_t> candidates, uint64_t count,
                                             uint64_t randomSeed) {
  std::vector<uint32_t> permutation(candidates.begin(), candidates.end());
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(permutation));
  const uint64_t size = permutation.size();
  std::vector<uint32_t> seeds(static_cast<size_t>(std::min(count, size)));
  for (uint64_t i = 0; i < seeds.size(); ++i) seeds[i] = permutation[i * size / seeds.size()];
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

}  // namespace asdfvk
