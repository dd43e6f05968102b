#include <algorithm>
#include <utility>

#include "core/random.h"
#include "seeds/dart_throwing.h"
#include "seeds/samplers.h"
#include "seeds/surface_distances.h"

namespace asdfvk {

std::vector<uint32_t> farthestPointSeeds(const SeedDomain& domain, uint64_t count, std::span<const uint32_t> existing,
                                         uint64_t randomSeed) {
  std::vector<uint32_t> waiting = remainingCandidates(domain, existing);
  if (count >= waiting.size()) return waiting;
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(waiting));
  const UnsetVector<float> lengths = arcLengths(domain.arcAngles.get());
  SurfaceDistances distances(domain.graph, lengths);
  distances.add(existing, SurfaceDistances::kUnreached);
  std::vector<uint32_t> seeds =
      throwDarts(std::move(waiting), count, SurfaceDistances::kUnreached, distances, domain.stopOnly).faces;
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

}  // namespace asdfvk
