#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

inline constexpr uint32_t kNoNeighbour = std::numeric_limits<uint32_t>::max();

/// #F. The face across each edge of a triangle; entry i belongs to the edge from corner i to the next corner.
using FaceNeighbours = std::vector<std::array<uint32_t, 3>>;

/// The neighbours in a manifold, consistently oriented surface: across an edge of exactly two faces that traverse it in
/// opposite directions. An edge of more faces is first divided, as CGAL's readers do by splitting vertices: its faces
/// stay together where such neighbours connect them around both ends. There is kNoNeighbour at boundary edges, at edges
/// between faces of opposite winding, and at all edges of faces with a repeated vertex or a non-finite corner, which
/// count for no edge. Vertices are compared by index. Two faces that share several edges are neighbours across each.
/// Precondition: every index of a face is below the vertex count.
[[nodiscard]] FaceNeighbours findFaceNeighbours(const TriangleMesh& mesh);

}  // namespace asdfvk
