#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

inline constexpr uint32_t kNoNeighbour = std::numeric_limits<uint32_t>::max();

/// #F: the faces across the three edges of each triangle. Entry i belongs to the edge from corner i to the next corner.
using FaceNeighbours = std::vector<std::array<uint32_t, 3>>;

/// The neighbours in a manifold, consistently oriented surface. Two faces are neighbours across an edge if exactly
/// these two have the edge, and traverse it in opposite directions. An edge of more than two faces is
/// first divided: two of its faces keep a common edge if chains of neighbours connect the two faces around both ends of
/// the edge. CGAL's readers have the same effect, because they split vertices. kNoNeighbour marks boundary edges, edges
/// between faces of opposite winding, and all edges of faces with a repeated vertex or a non-finite corner. Faces with
/// a repeated vertex or a non-finite corner are not counted at any edge. Vertices are compared by index. Two faces that
/// share several edges are neighbours across each of them. Precondition: every vertex index is below the vertex count.
[[nodiscard]] FaceNeighbours findFaceNeighbours(const TriangleMesh& mesh);

}  // namespace asdfvk
