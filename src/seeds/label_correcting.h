#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

struct FaceDistance {
  float distance = 0;
  uint32_t face = 0;
};

inline constexpr auto kNearestOnTop = [](const auto& a, const auto& b) { return a.distance > b.distance; };

/// Number of arcs from the start faces after which correctLabels() changes from a queue to a heap.
inline constexpr int kMaxQueueRounds = 64;

/// A face that is to be visited.
struct PendingFace {
  float distance = 0;
  uint32_t node = 0;    ///< Number that Labels::lower() returns.
  uint32_t parent = 0;  ///< The face before it on the path, or itself.
};

/// Shortest paths from the pending faces along arcs of positive length. Labels holds the distances found so far, those
/// of the pending faces included, in nodes of its own numbering:
///
///     float at(uint32_t node)
///     uint32_t faceOf(uint32_t node)
///     bool lower(uint32_t face, float distance, uint32_t& node)  // If the label is above distance: stores it, sets
///                                                                // node, and returns true.
/// Faces at `limit` or more are not reached. Afterwards `pending` is empty.
///
/// The order of the visits does not change the labels: addition in float is monotonic, so that each label becomes the
/// least sum over all paths. The faces are therefore visited in the order of a queue (Moore, "The shortest path through
/// a maze", 1959), which is faster than a heap while paths have few arcs. Farther faces are visited in the order of a
/// heap (Dijkstra 1959), which bounds the time for any arc lengths.
template <typename Labels>
void correctLabels(const DualGraph& graph, std::span<const float> arcLengths, float limit,
                   std::vector<PendingFace>& pending, Labels&& labels) {
  const auto visit = [&](const PendingFace& from, const auto& put) {
    if (from.distance > labels.at(from.node)) return;
    const uint32_t face = labels.faceOf(from.node);
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      const uint32_t neighbour = graph.neighbours[arc];
      if (neighbour == from.parent) continue;
      PendingFace to{from.distance + arcLengths[arc], 0, face};
      if (to.distance < limit && labels.lower(neighbour, to.distance, to.node)) put(to);
    }
  };
  size_t next = 0;
  for (int round = 0; round < kMaxQueueRounds && next < pending.size(); ++round) {
    for (const size_t end = pending.size(); next < end; ++next)
      visit(PendingFace(pending[next]), [&](const PendingFace& to) { pending.push_back(to); });
  }
  pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(next));
  std::make_heap(pending.begin(), pending.end(), kNearestOnTop);
  while (!pending.empty()) {
    std::pop_heap(pending.begin(), pending.end(), kNearestOnTop);
    const PendingFace nearest = pending.back();
    pending.pop_back();
    visit(nearest, [&](const PendingFace& to) {
      pending.push_back(to);
      std::push_heap(pending.begin(), pending.end(), kNearestOnTop);
    });
  }
}

}  // namespace asdfvk
