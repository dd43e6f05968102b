#pragma once

#include <cstdint>
#include <span>

#include "core/unset_vector.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// If more faces than this share an edge, each of these faces is joined only to the previous and the next one in file
/// order. Therefore the size of the graph is not quadratic in the number of faces.
inline constexpr uint32_t kMaxFacesJoinedAllToAll = 32;

/// The dual graph: a node per face, and for each shared mesh edge an arc in each direction. Faces that share two edges
/// have two arcs in each direction. Compressed rows: the neighbours of face f are neighbours[offsets[f]] ..
/// neighbours[offsets[f + 1] - 1], in ascending order.
struct DualGraph {
  UnsetVector<uint32_t> offsets;     ///< #F+1
  UnsetVector<uint32_t> neighbours;  ///< Face indices.

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(offsets.size() - 1); }
  [[nodiscard]] std::span<const uint32_t> neighboursOf(uint32_t face) const {
    return {neighbours.data() + offsets[face], neighbours.data() + offsets[face + 1]};
  }
};

/// Class of an edge by its proper faces. A face is proper if it has finite corners and three distinct vertices.
enum class EdgeKind : uint8_t {
  Regular,       ///< The edge has two faces, which traverse it in opposite directions.
  Inconsistent,  ///< The edge has two faces, which traverse it in the same direction.
  Boundary,      ///< The edge has one face.
  NonManifold,   ///< The edge has more than two faces.
};

/// Results of one pass over the edges of a mesh.
struct EdgeSurvey {
  DualGraph graph;  ///< See buildDualGraph().
  /// #F x 3: entry 3 f + i is the kind of the edge from corner i of face f to the next corner. The kind is Regular if f
  /// is not proper.
  UnsetVector<EdgeKind> edgeKinds;
  uint64_t boundaryEdgeCount = 0;
  uint64_t nonManifoldEdgeCount = 0;
  uint64_t inconsistentEdgeCount = 0;
  bool isClosed = false;  ///< Every face is proper, and each edge has exactly two faces.
};

/// Precondition: every index of a face is below the vertex count. Throws Error{MeshTooLarge} for more than 2^32 - 1
/// edges or arcs.
[[nodiscard]] EdgeSurvey surveyEdges(const TriangleMesh& mesh);

/// The dual graph of surveyEdges(). Edges are matched by sorting, so that non-manifold input is valid. An edge of k
/// faces joins all of its faces (but see kMaxFacesJoinedAllToAll); a boundary edge joins no faces. Edges from a vertex
/// to itself and edges of faces with a non-finite corner join no faces. Vertices are compared by index, not by
/// position: a mesh whose faces share no vertices is open everywhere.
[[nodiscard]] inline DualGraph buildDualGraph(const TriangleMesh& mesh) { return surveyEdges(mesh).graph; }

}  // namespace asdfvk
