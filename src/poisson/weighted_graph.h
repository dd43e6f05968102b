#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// A dual graph with a weight per arc, in the order of graph.neighbours, as its rows are walked along everywhere.
struct WeightedGraph {
  const DualGraph& graph;
  std::span<const double> weights;

  /// Calls visit(g, w_fg) for each neighbour of face f in ascending order: one over several edges comes once, with the
  /// sum of their weights, and an arc from f to itself does not come.
  template <typename Visit>
  void visitNeighbours(uint32_t face, const Visit& visit) const {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1];) {
      const uint32_t neighbour = graph.neighbours[arc];
      double weight = 0;
      for (; arc < graph.offsets[face + 1] && graph.neighbours[arc] == neighbour; ++arc) weight += weights[arc];
      if (neighbour != face) visit(neighbour, weight);
    }
  }
};

/// What a vector over the faces says at one of them: 0 where it says nothing, or is empty.
[[nodiscard]] inline double finiteOrZero(std::span<const double> perFace, uint32_t face) {
  return !perFace.empty() && std::isfinite(perFace[face]) ? perFace[face] : 0;
}

}  // namespace asdfvk
