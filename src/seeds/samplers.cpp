#include "seeds/samplers.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {

std::vector<uint32_t> remainingCandidates(const SeedDomain& domain, std::span<const uint32_t> existing) {
  std::vector<uint8_t> isChosen(domain.graph.faceCount(), 0);
  for (uint32_t face : existing) {
    ASDFVK_CHECK_OP(face, <, domain.graph.faceCount());
    isChosen[face] = 1;
  }
  return selectInParallel(domain.candidates, [&](uint32_t face) { return !isChosen[face]; });
}

const Sampler& samplerOf(SamplerChoice choice) {
  const auto found =
      std::find_if(kSamplers.begin(), kSamplers.end(), [&](const Sampler& s) { return s.choice == choice; });
  ASDFVK_CHECK(found != kSamplers.end());
  return *found;
}

}  // namespace asdfvk
