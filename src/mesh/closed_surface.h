#pragma once

#include <cstdint>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Corners on the border of the surface that are at most this far apart are one point. Normalised: coordinates in
/// float32 do not resolve less.
inline constexpr double kWeldDistance = kContactDistance;
/// The same for exports of CAD programs, which round the corners of each patch on its own: 1e-5 of the longest side of
/// the bounding box, where it closes a component.
inline constexpr double kCadWeldDistance = 2e-5;

/// The edges of a surface whose corners are compared by position.
struct SurfaceEdges {
  EdgeSurvey survey;
  /// #F: the faces with welded vertices; empty if no vertex was welded.
  std::vector<Face> faces;
  /// #V: the vertex that replaces each vertex in `faces`; empty if no vertex was welded.
  std::vector<uint32_t> vertexOf;
  uint64_t weldedVertexCount = 0;  ///< Vertices that were replaced.
  bool hasTJunctions = false;      ///< An end of an edge lies inside of another edge.
  double weldDistance = 0;         ///< The greatest distance between a vertex and its replacement, normalised.
};

/// Surveys the edges of a mesh. Vertices of edges that are not regular (EdgeKind) are welded, and T-junctions closed
/// (edge_chain.h). In this way split vertices, nearly equal vertices and edges that lie on several others do not open a
/// surface. A mesh without such edges is only surveyed. Throws the errors of surveyEdges().
[[nodiscard]] SurfaceEdges surveySurface(const TriangleMesh& mesh, const Normalization& unit);

/// A triangle that is a part of a face, or all of it.
struct FacePart {
  Face vertices;
  uint32_t face = 0;
};

/// The faces of a surface such that neighbours have whole edges in common: vertices of open edges are welded at
/// kWeldDistance, and faces are divided at the vertices on their edges. In the order of the faces. Throws the errors of
/// surveyEdges().
[[nodiscard]] std::vector<FacePart> conformingFaces(const TriangleMesh& mesh, const Normalization& unit);

}  // namespace asdfvk
