#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/unset_vector.h"
#include "core/vec3.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// If more faces than this share an edge, each of these faces is joined only to the previous and the next one in file
/// order. Therefore the size of the graph is not quadratic in the number of faces.
inline constexpr uint32_t kMaxFacesJoinedAllToAll = 32;

/// The dual graph: a node per face, and for each pair of faces that an edge joins an arc in each direction. Faces that
/// two edges join have two arcs in each direction. Compressed rows: the neighbours of face f are neighbours[offsets[f]]
/// .. neighbours[offsets[f + 1] - 1], in ascending order.
struct DualGraph {
  UnsetVector<uint32_t> offsets;     ///< #F+1
  UnsetVector<uint32_t> neighbours;  ///< Face indices.

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(offsets.size() - 1); }
  [[nodiscard]] std::span<const uint32_t> neighboursOf(uint32_t face) const {
    return {neighbours.data() + offsets[face], neighbours.data() + offsets[face + 1]};
  }
};

/// Class of an edge by the sum over its proper faces, in which a face that traverses the edge in one direction counts
/// 1, and a face that traverses it in the other direction -1. A face is proper if it has finite corners and three
/// distinct vertices. A surface is closed if no edge has a sum.
enum class EdgeKind : uint8_t {
  Regular,       ///< The sum is 0: the edge has as many faces in one direction as in the other.
  Inconsistent,  ///< The sum is even: turning faces makes it 0.
  Boundary,      ///< The edge has one face.
  Branching,     ///< The sum is odd, and the edge has three faces or more.
};
inline constexpr size_t kEdgeKindCount = 4;

/// The edges of one kind.
struct EdgesOfKind {
  uint64_t count = 0;
  uint32_t firstCorner = UINT32_MAX;  ///< The lowest 3 f + i; see EdgeSurvey::edgeKinds.
  Vec3d place;                        ///< A point on the edge of `firstCorner` where the surface is not closed.
};

/// Results of one pass over the edges of a mesh.
struct EdgeSurvey {
  DualGraph graph;  ///< See buildDualGraph().
  /// #F x 3: entry 3 f + i is the kind of the edge from corner i of face f to the next corner. The kind is Regular if f
  /// is not proper.
  UnsetVector<EdgeKind> edgeKinds;
  std::array<EdgesOfKind, kEdgeKindCount> edges;  ///< By EdgeKind; regular edges are not counted.
  uint64_t nonManifoldEdgeCount = 0;              ///< Edges that have more than two proper faces.
  bool isManifold = false;                        ///< Every face is proper, and each edge has exactly two faces.

  [[nodiscard]] const EdgesOfKind& of(EdgeKind kind) const { return edges[static_cast<size_t>(kind)]; }
  [[nodiscard]] uint64_t countOf(EdgeKind kind) const { return of(kind).count; }
  /// Whether no edge has a sum.
  [[nodiscard]] bool isChainClosed() const {
    return countOf(EdgeKind::Inconsistent) + countOf(EdgeKind::Boundary) + countOf(EdgeKind::Branching) == 0;
  }
};

/// Precondition: every index of a face is below the vertex count. Throws Error{MeshTooLarge} for more than 2^32 - 1
/// edges or arcs.
[[nodiscard]] EdgeSurvey surveyEdges(const TriangleMesh& mesh);

/// The dual graph of surveyEdges(). Edges are matched by sorting, so that non-manifold input is valid. A regular edge
/// of more than two faces joins them in pairs: the two faces of a pair bound the same material beside the edge
/// (edge_pairs.h), so that bodies that touch remain separate. Any other edge of k faces joins all of its faces (but see
/// kMaxFacesJoinedAllToAll); a boundary edge joins no faces. Edges from a vertex to itself and edges of faces with a
/// non-finite corner join no faces. Vertices are compared by index, not by position (see closed_surface.h).
[[nodiscard]] inline DualGraph buildDualGraph(const TriangleMesh& mesh) { return surveyEdges(mesh).graph; }

}  // namespace asdfvk
