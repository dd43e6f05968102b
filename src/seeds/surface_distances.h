#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// The distance of each face to the nearest of a growing set of seeds along the arcs of the dual graph, by Dijkstra's
/// algorithm from each new seed, stopped where an older seed is as near: a new seed costs what it takes from the
/// others, not the whole graph. The graph and the lengths must outlive it.
class SurfaceDistances {
 public:
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  /// arcLengths: aligned with graph.neighbours, positive, the same in both directions. No seed yet.
  SurfaceDistances(const DualGraph& graph, std::span<const float> arcLengths);

  /// Adds seeds. Afterwards each distance below `limit` is known; a larger one may read as larger than it is.
  /// Precondition: limits do not grow from call to call until clear().
  void add(std::span<const uint32_t> seeds, float limit);

  /// 0 for a seed.
  [[nodiscard]] float at(uint32_t face) const { return distances_[face]; }

  /// Has at(face), and what adding the face will need first, on its way from memory when it is asked for.
  void fetch(uint32_t face) const {
    __builtin_prefetch(&distances_[face]);
    __builtin_prefetch(&graph_.offsets[face]);
  }

  /// Forgets all seeds.
  void clear();

 private:
  struct Entry {
    float distance;
    uint32_t face;
  };
  void fetchArcs(uint32_t face) const;
  void push(Entry entry);
  [[nodiscard]] Entry pop();

  const DualGraph& graph_;
  std::span<const float> arcLengths_;
  std::vector<float> distances_;  ///< #F
  std::vector<Entry> heap_;       ///< Empty between calls; kept for its memory.
};

}  // namespace asdfvk
