#include "seeds/seed_domain.h"

#include <algorithm>
#include <iterator>

#include "core/check.h"

namespace asdfvk {

std::vector<uint32_t> unchosenCandidates(const SeedDomain& domain, std::span<const uint32_t> existing) {
  std::vector<uint8_t> isChosen(domain.graph.faceCount(), 0);
  for (uint32_t face : existing) {
    ASDFVK_CHECK_OP(face, <, domain.graph.faceCount());
    isChosen[face] = 1;
  }
  std::vector<uint32_t> unchosen;
  unchosen.reserve(domain.candidates.size());
  std::copy_if(domain.candidates.begin(), domain.candidates.end(), std::back_inserter(unchosen),
               [&](uint32_t face) { return !isChosen[face]; });
  return unchosen;
}

}  // namespace asdfvk
