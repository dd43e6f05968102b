#include "seeds/samplers.h"

#include <algorithm>
#include <iterator>

#include "core/check.h"

namespace asdfvk {

std::vector<uint32_t> remainingCandidates(const SeedDomain& domain, std::span<const uint32_t> existing) {
  std::vector<uint8_t> isChosen(domain.graph.faceCount(), 0);
  for (uint32_t face : existing) {
    ASDFVK_CHECK_OP(face, <, domain.graph.faceCount());
    isChosen[face] = 1;
  }
  std::vector<uint32_t> remaining;
  remaining.reserve(domain.candidates.size());
  std::copy_if(domain.candidates.begin(), domain.candidates.end(), std::back_inserter(remaining),
               [&](uint32_t face) { return !isChosen[face]; });
  return remaining;
}

const Sampler* findSampler(std::string_view name) {
  const auto found = std::find_if(kSamplers.begin(), kSamplers.end(), [&](const Sampler& s) { return s.name == name; });
  return found == kSamplers.end() ? nullptr : &*found;
}

}  // namespace asdfvk
