#include "segment/face_neighbours.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "mesh/edges.h"

namespace asdfvk {
namespace {

using CornerPair = std::pair<uint32_t, uint32_t>;

bool isTraversedBothWays(const TriangleMesh& mesh, uint32_t first, uint32_t second) {
  return mesh.faces[first / 3][first % 3] != mesh.faces[second / 3][second % 3];
}

/// The umbrella of a corner consists of faces around the vertex of the corner: the face of the corner, and the faces
/// that chains of neighbours connect to it. Returns the lowest corner (number 3 f + i) in the umbrella.
uint32_t umbrellaOf(const TriangleMesh& mesh, const FaceNeighbours& neighbours, uint32_t corner) {
  const uint32_t vertex = mesh.faces[corner / 3][corner % 3];
  uint32_t lowest = corner;
  // First steps across the edge that begins at the vertex, then across the edge that ends at the vertex.
  for (const uint32_t step : {0u, 2u})
    for (uint32_t at = corner;;) {
      const uint32_t next = neighbours[at / 3][(at % 3 + step) % 3];
      if (next == kNoNeighbour) break;
      const Face& face = mesh.faces[next];
      at = 3 * next + static_cast<uint32_t>(std::find(face.begin(), face.end(), vertex) - face.begin());
      if (at == corner) return lowest;
      lowest = std::min(lowest, at);
    }
  return lowest;
}

}  // namespace

FaceNeighbours findFaceNeighbours(const TriangleMesh& mesh) {
  FaceNeighbours neighbours(mesh.faces.size(), {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  const auto join = [&](uint32_t first, uint32_t second) {
    neighbours[first / 3][first % 3] = second / 3;
    neighbours[second / 3][second % 3] = first / 3;
  };
  const EdgeTable edges(mesh,
                        [&](uint32_t f) { return hasDistinctVertices(mesh.faces[f]) && mesh.hasFiniteCorners(f); });
  PerThread<std::vector<std::vector<uint32_t>>> cornersOfCrowdedEdges;
  edges.forEachEdge([&](uint32_t, std::span<const EdgeEntry> entries) {
    if (entries.size() == 2) {
      if (isTraversedBothWays(mesh, entries[0].corner, entries[1].corner)) join(entries[0].corner, entries[1].corner);
    } else if (entries.size() > 2) {
      std::vector<uint32_t> corners;
      for (const EdgeEntry& entry : entries) corners.push_back(entry.corner);
      cornersOfCrowdedEdges.local().push_back(std::move(corners));
    }
  });
  std::vector<CornerPair> joined;
  const auto joinCrowded = [&](const std::vector<uint32_t>& corners) {
    // Corners, sorted by the umbrellas at the lower and at the higher vertex of the edge.
    std::vector<std::pair<CornerPair, uint32_t>> sorted;
    for (const uint32_t corner : corners) {
      CornerPair ends{umbrellaOf(mesh, neighbours, corner),
                      umbrellaOf(mesh, neighbours, corner - corner % 3 + (corner % 3 + 1) % 3)};
      const Face& face = mesh.faces[corner / 3];
      if (face[corner % 3] > face[(corner % 3 + 1) % 3]) std::swap(ends.first, ends.second);
      sorted.emplace_back(ends, corner);
    }
    std::sort(sorted.begin(), sorted.end());
    for (size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
      while (end < sorted.size() && sorted[end].first == sorted[begin].first) ++end;
      if (end - begin == 2 && isTraversedBothWays(mesh, sorted[begin].second, sorted[begin + 1].second))
        joined.emplace_back(sorted[begin].second, sorted[begin + 1].second);
    }
  };
  cornersOfCrowdedEdges.forEach([&](const std::vector<std::vector<uint32_t>>& ofThread) {
    for (const std::vector<uint32_t>& corners : ofThread) joinCrowded(corners);
  });
  for (const auto& [first, second] : joined) join(first, second);
  return neighbours;
}

}  // namespace asdfvk
