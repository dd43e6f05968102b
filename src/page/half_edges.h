#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// No half-edge, face, vertex or gate.
inline constexpr uint32_t kNone = 0xffffffff;

/// Whether the page connects the face over its edges: finite corners and three distinct vertices.
[[nodiscard]] inline bool isConnectable(const TriangleMesh& mesh, uint32_t face) {
  return hasDistinctVertices(mesh.faces[face]) && mesh.hasFiniteCorners(face);
}

/// Half-edge 3 f + i leads from corner i of face f to its next corner. The entry is the half-edge of another face in
/// the opposite direction, or kNone; symmetric. An edge of more than two faces has as many pairs as directions allow.
[[nodiscard]] std::vector<uint32_t> pairHalfEdges(const TriangleMesh& mesh);

[[nodiscard]] constexpr uint32_t nextHalfEdge(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
[[nodiscard]] constexpr uint32_t previousHalfEdge(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

}  // namespace asdfvk
