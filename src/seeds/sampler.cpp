#include "seeds/sampler.h"

#include "core/check.h"
#include "seeds/blue_noise.h"
#include "seeds/depth_first.h"
#include "seeds/farthest_point.h"
#include "seeds/normal_space.h"
#include "seeds/random_permutation.h"

namespace asdfvk {

std::vector<uint32_t> sampleSeeds(SamplerKind kind, SurfaceMetric metric, const SeedDomain& domain, uint64_t count,
                                  std::span<const uint32_t> existing, uint64_t randomSeed) {
  switch (kind) {
    case SamplerKind::Random:
      return randomPermutationSeeds(unchosenCandidates(domain, existing), count, randomSeed);
    case SamplerKind::DepthFirst:
      return depthFirstSeeds(domain, count, existing, randomSeed);
    case SamplerKind::BlueNoise:
      return blueNoiseSeeds(domain, metric, count, existing, randomSeed);
    case SamplerKind::FarthestPoint:
      return farthestPointSeeds(domain, metric, count, existing, randomSeed);
    case SamplerKind::NormalSpace:
      return normalSpaceSeeds(domain, count, existing, randomSeed);
  }
  ASDFVK_CHECK(!"a sampler that exists");
  return {};
}

}  // namespace asdfvk
