#pragma once

#include <cstdint>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Two faces whose edges cover each other at a T-junction.
struct TJunction {
  uint32_t face = 0, other = 0;
  bool isSameDirection = false;  ///< The faces traverse the common part of their edges in the same direction.
};

/// Sums the edges that are not regular again, as a geometric chain: each of them is divided at the ends of others that
/// lie on it, up to `tolerance` (normalised). An edge whose parts have no sum becomes regular, and an edge whose parts
/// have even sums becomes inconsistent. Faces whose edges have a common part are joined in the dual graph. Returns
/// these pairs of faces.
std::vector<TJunction> sumAsChain(const TriangleMesh& mesh, const Normalization& unit, double tolerance,
                                  EdgeSurvey& survey);

/// The vertices on an edge of a face, without the ends of the edge.
struct DividedEdge {
  uint32_t corner = 0;             ///< 3 f + i; see EdgeSurvey::edgeKinds.
  std::vector<uint32_t> vertices;  ///< In the direction in which the face traverses the edge.
};

/// Finds the edges on which an end of an open edge lies, up to `tolerance` (normalised). An edge is open if its kind is
/// not Regular. An edge of several faces is listed for each of them.
[[nodiscard]] std::vector<DividedEdge> findDividedEdges(const TriangleMesh& mesh, const Normalization& unit,
                                                        double tolerance, const EdgeSurvey& survey);

}  // namespace asdfvk
