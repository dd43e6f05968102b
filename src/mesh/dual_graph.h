#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// An edge shared by more faces than this joins each only to its predecessor and its successor in file order, so that
/// the size of the graph is never quadratic.
inline constexpr uint32_t kMaxFacesJoinedAllToAll = 32;

/// The dual graph: a node per face, an arc in both directions per shared mesh edge (two faces that share two edges have
/// two arcs). Compressed rows: the neighbours of face f are neighbours[offsets[f]] .. neighbours[offsets[f + 1] - 1],
/// in ascending order.
struct DualGraph {
  std::vector<uint32_t> offsets;     ///< #F+1
  std::vector<uint32_t> neighbours;  ///< Face indices.

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(offsets.size() - 1); }
  [[nodiscard]] std::span<const uint32_t> neighboursOf(uint32_t face) const {
    return {neighbours.data() + offsets[face], neighbours.data() + offsets[face + 1]};
  }
};

/// Edges are matched by sorting, so that non-manifold input is valid: an edge of k faces joins all of them (but see
/// kMaxFacesJoinedAllToAll), a boundary edge none. An edge between a vertex and itself and a face with a non-finite
/// corner join nothing. Vertices are compared by index, not by position: a mesh whose faces share no vertices is open
/// everywhere. Precondition: every index of a face is below the vertex count.
[[nodiscard]] DualGraph buildDualGraph(const TriangleMesh& mesh);

}  // namespace asdfvk
