#include "segment/face_neighbours.h"

#include <span>

#include "mesh/edges.h"

namespace asdfvk {

FaceNeighbours findFaceNeighbours(const TriangleMesh& mesh) {
  FaceNeighbours neighbours(mesh.faces.size(), {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  const EdgeTable edges(mesh,
                        [&](uint32_t f) { return hasDistinctVertices(mesh.faces[f]) && mesh.hasFiniteCorners(f); });
  edges.forEachEdge([&](uint32_t lower, std::span<const EdgeEntry> entries) {
    if (entries.size() != 2) return;
    const auto [first, second] = std::array{entries[0].corner, entries[1].corner};
    const auto beginsAtLower = [&](uint32_t corner) { return mesh.faces[corner / 3][corner % 3] == lower; };
    if (beginsAtLower(first) == beginsAtLower(second)) return;
    neighbours[first / 3][first % 3] = second / 3;
    neighbours[second / 3][second % 3] = first / 3;
  });
  return neighbours;
}

}  // namespace asdfvk
