#pragma once

#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "core/random.h"
#include "generate/shapes.h"
#include "mesh/dual_graph.h"

namespace asdfvk::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A dual graph from its rows.
inline DualGraph graphOf(const std::vector<std::vector<uint32_t>>& rows) {
  DualGraph graph;
  graph.offsets.push_back(0);
  for (const std::vector<uint32_t>& row : rows) {
    graph.neighbours.insert(graph.neighbours.end(), row.begin(), row.end());
    graph.offsets.push_back(static_cast<uint32_t>(graph.neighbours.size()));
  }
  return graph;
}

/// The faces of a triangle strip, each connected to the one before and the one after it.
inline DualGraph stripGraph(uint32_t faceCount) {
  DualGraph graph;
  graph.offsets.push_back(0);
  for (uint32_t face = 0; face < faceCount; ++face) {
    if (face > 0) graph.neighbours.push_back(face - 1);
    if (face + 1 < faceCount) graph.neighbours.push_back(face + 1);
    graph.offsets.push_back(static_cast<uint32_t>(graph.neighbours.size()));
  }
  return graph;
}

/// Every two faces connected by `arcCount` arcs.
inline DualGraph completeGraph(uint32_t faceCount, uint32_t arcCount = 1) {
  std::vector<std::vector<uint32_t>> rows(faceCount);
  for (uint32_t face = 0; face < faceCount; ++face)
    for (uint32_t other = 0; other < faceCount; ++other)
      if (other != face) rows[face].insert(rows[face].end(), arcCount, other);
  return graphOf(rows);
}

/// Faces that share all three edges.
inline DualGraph coincidentGraph(uint32_t faceCount) { return completeGraph(faceCount, 3); }

inline DualGraph torusGraph(uint64_t faceCount) { return buildDualGraph(generateShape("torus", faceCount).mesh); }

/// Number of arcs from `from`, ~0u beyond `limit`: breadth-first search over all faces.
inline std::vector<uint32_t> hopsFrom(const DualGraph& graph, uint32_t from, uint32_t limit) {
  std::vector<uint32_t> hops(graph.faceCount(), ~0u);
  std::queue<uint32_t> queue({from});
  for (hops[from] = 0; !queue.empty(); queue.pop())
    for (uint32_t neighbour : graph.neighboursOf(queue.front()))
      if (hops[neighbour] == ~0u && hops[queue.front()] < limit) {
        hops[neighbour] = hops[queue.front()] + 1;
        queue.push(neighbour);
      }
  return hops;
}

/// Uniform in level - amplitude .. level + amplitude.
inline std::vector<double> noisyField(uint32_t faceCount, double level, double amplitude) {
  Random random(5);
  std::vector<double> values(faceCount);
  for (double& value : values) value = level + amplitude * (2 * random.real() - 1);
  return values;
}

}  // namespace asdfvk::test
