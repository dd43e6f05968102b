#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/edges.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Two corners 3 f + i of different faces, with the same edge.
using CornerPair = std::pair<uint32_t, uint32_t>;

/// Divides the faces around one edge into pairs that traverse it in opposite directions. Between the two faces of a
/// pair is material: seen along the edge, pairs are nested like parentheses. Faces at the same angle, which touch each
/// other, belong to different pairs. Among copies of a pair, faces of lower index come first. Returns no pair if the
/// edge does not have as many faces in one direction as in the other. Precondition: the faces are proper (EdgeKind).
[[nodiscard]] std::vector<CornerPair> pairsAroundEdge(const TriangleMesh& mesh, std::span<const EdgeEntry> around);

}  // namespace asdfvk
