#pragma once

#include <cstdint>
#include <vector>

#include "mesh/closed_surface.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// #F: the faces that have to be reversed so that no two neighbours are wound against each other; of each connected set
/// of faces, the smaller part. Neighbours have a common edge of two faces, or a common part of their edges
/// (edge_chain.h). A set that cannot be oriented, such as a Moebius strip, is left as it is. edges: the survey of the
/// mesh. Empty if no edge is inconsistent.
[[nodiscard]] std::vector<uint8_t> findTurnedFaces(const TriangleMesh& mesh, const Normalization& unit,
                                                   const SurfaceEdges& edges);

/// Whether reversing the faces of findTurnedFaces() leaves no inconsistent edge.
[[nodiscard]] bool canBeTurned(TriangleMesh mesh, const Normalization& unit);

}  // namespace asdfvk
