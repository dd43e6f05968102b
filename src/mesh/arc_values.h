#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "mesh/dual_graph.h"

namespace asdfvk {

/// Sets perArc[arc] to valueOf(f, g) for each arc from f to g and each arc from g to f, where f <= g. Runs in parallel.
/// prefetch(g): prefetches the memory that valueOf(f, g) will read of g.
template <typename Value, typename ValueOf, typename Prefetch>
void setForEachPair(const DualGraph& graph, std::span<Value> perArc, const ValueOf& valueOf, const Prefetch& prefetch) {
  constexpr size_t kBlockSize = 128;        // Unit: faces.
  constexpr size_t kPrefetchDistance = 16;  // Unit: pairs.
  struct Pair {
    uint32_t arc, face, neighbour;
  };
  forEachRange(graph.faceCount(), kItemsPerTask / 4, [&](size_t begin, size_t end) {
    std::vector<Pair> pairs;
    for (size_t first = begin; first < end; first += kBlockSize) {
      // Three loops: mispredicted branches of the first and the last do not delay the computation of the values.
      const size_t last = std::min(first + kBlockSize, end);
      pairs.resize(graph.offsets[last] - graph.offsets[first]);
      size_t count = 0;
      for (auto face = static_cast<uint32_t>(first); face < last; ++face)
        for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
          pairs[count] = {arc, face, graph.neighbours[arc]};
          count += graph.neighbours[arc] >= face ? 1 : 0;
        }
      for (size_t i = 0; i < count; ++i) {
        prefetch(pairs[std::min(i + kPrefetchDistance, count - 1)].neighbour);
        perArc[pairs[i].arc] = valueOf(pairs[i].face, pairs[i].neighbour);
      }
      for (size_t i = 0; i < count; ++i) {
        const auto& [arc, face, neighbour] = pairs[i];
        // The faces may share several edges.
        const std::span<const uint32_t> back = graph.neighboursOf(neighbour);
        const auto [backBegin, backEnd] = std::equal_range(back.begin(), back.end(), face);
        std::fill_n(perArc.begin() + graph.offsets[neighbour] + (backBegin - back.begin()), backEnd - backBegin,
                    perArc[arc]);
      }
    }
  });
}

}  // namespace asdfvk
