#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/parallel.h"
#include "mesh/dual_graph.h"

namespace asdfvk {

/// Sets perArc[arc] to valueOf(f, g) for each arc from f to g and each arc from g to f, where f <= g. Runs in parallel.
/// prefetch(g): prefetches the memory that valueOf(f, g) will read of g.
template <typename Value, typename ValueOf, typename Prefetch>
void setForEachPair(const DualGraph& graph, std::span<Value> perArc, const ValueOf& valueOf, const Prefetch& prefetch) {
  constexpr uint32_t kPrefetchDistance = 32;  // Unit: faces.
  forEachInParallel(graph.faceCount(), [&](uint32_t face) {
    if (face + kPrefetchDistance < graph.faceCount())
      for (const uint32_t neighbour : graph.neighboursOf(face + kPrefetchDistance)) prefetch(neighbour);
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      const uint32_t neighbour = graph.neighbours[arc];
      if (neighbour < face) continue;
      perArc[arc] = valueOf(face, neighbour);
      // The faces may share several edges.
      const std::span<const uint32_t> back = graph.neighboursOf(neighbour);
      const auto [begin, end] = std::equal_range(back.begin(), back.end(), face);
      std::fill_n(perArc.begin() + graph.offsets[neighbour] + (begin - back.begin()), end - begin, perArc[arc]);
    }
  });
}

}  // namespace asdfvk
