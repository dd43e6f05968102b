#include "seeds/surface_distances.h"

#include <algorithm>

#include "core/check.h"

namespace asdfvk {

SurfaceDistances::SurfaceDistances(const DualGraph& graph, std::span<const float> arcLengths)
    : graph_(graph), arcLengths_(arcLengths), distances_(graph.faceCount(), kUnreached) {
  ASDFVK_CHECK_OP(arcLengths.size(), ==, graph.neighbours.size());
}

// A face that is pushed is soon popped, and its neighbours stand anywhere in memory.
void SurfaceDistances::fetchArcs(uint32_t face) const {
  const uint32_t arc = graph_.offsets[face];
  if (arc == graph_.neighbours.size()) return;
  __builtin_prefetch(&graph_.neighbours[arc]);
  __builtin_prefetch(&arcLengths_[arc]);
}

void SurfaceDistances::push(Entry entry) {
  heap_.push_back(entry);
  std::push_heap(heap_.begin(), heap_.end(), [](const Entry& a, const Entry& b) { return a.distance > b.distance; });
}

SurfaceDistances::Entry SurfaceDistances::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), [](const Entry& a, const Entry& b) { return a.distance > b.distance; });
  const Entry entry = heap_.back();
  heap_.pop_back();
  return entry;
}

void SurfaceDistances::add(std::span<const uint32_t> seeds, float limit) {
  for (uint32_t seed : seeds) {
    distances_[seed] = 0;
    fetchArcs(seed);
    push({0, seed});
  }
  while (!heap_.empty()) {
    const Entry entry = pop();
    if (entry.distance > distances_[entry.face]) continue;
    for (uint32_t arc = graph_.offsets[entry.face]; arc < graph_.offsets[entry.face + 1]; ++arc) {
      const float distance = entry.distance + arcLengths_[arc];
      float& known = distances_[graph_.neighbours[arc]];
      if (distance >= known || distance >= limit) continue;
      known = distance;
      fetchArcs(graph_.neighbours[arc]);
      push({distance, graph_.neighbours[arc]});
    }
  }
}

void SurfaceDistances::clear() { std::fill(distances_.begin(), distances_.end(), kUnreached); }

}  // namespace asdfvk
