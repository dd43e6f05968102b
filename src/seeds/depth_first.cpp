#include "seeds/depth_first.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace asdfvk {

std::vector<uint32_t> depthFirstOrder(const DualGraph& graph) {
  const uint32_t faceCount = graph.faceCount();
  std::vector<uint32_t> order, path;
  order.reserve(faceCount);
  std::vector<uint32_t> nextArc(graph.offsets.begin(), graph.offsets.end() - 1);
  std::vector<uint8_t> isSeen(faceCount, 0);
  const auto visit = [&](uint32_t face) {
    isSeen[face] = 1;
    order.push_back(face);
    path.push_back(face);
  };
  for (uint32_t root = 0; root < faceCount; ++root) {
    if (isSeen[root]) continue;
    for (visit(root); !path.empty();) {
      const uint32_t face = path.back();
      uint32_t& arc = nextArc[face];
      while (arc < graph.offsets[face + 1] && isSeen[graph.neighbours[arc]]) ++arc;
      if (arc < graph.offsets[face + 1])
        visit(graph.neighbours[arc]);
      else
        path.pop_back();
    }
  }
  return order;
}

std::vector<uint32_t> depthFirstSeeds(const SeedDomain& domain, uint64_t count, std::span<const uint32_t> existing,
                                      uint64_t randomSeed) {
  std::vector<uint32_t> unchosen = unchosenCandidates(domain, existing);
  if (count >= unchosen.size()) return unchosen;
  std::vector<uint8_t> isUnchosen(domain.graph.faceCount(), 0);
  for (uint32_t face : unchosen) isUnchosen[face] = 1;
  std::vector<uint32_t> order = depthFirstOrder(domain.graph);
  std::erase_if(order, [&](uint32_t face) { return !isUnchosen[face]; });
  // In whole numbers, of a 2^20th of a stride, so that no rounding makes two seeds one.
  constexpr uint64_t kPhases = 1u << 20;
  const uint64_t phase = Random(randomSeed).index(kPhases);
  std::vector<uint32_t> seeds(static_cast<size_t>(count));
  for (uint64_t i = 0; i < count; ++i) seeds[i] = order[(i * order.size() + phase * order.size() / kPhases) / count];
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

}  // namespace asdfvk
