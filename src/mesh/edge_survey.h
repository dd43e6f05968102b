#pragma once

#include <cstdint>

#include "mesh/dual_graph.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Results of one pass over the edges of a mesh.
struct EdgeSurvey {
  DualGraph graph;  ///< See buildDualGraph().
  // Over triangles with finite corners and three distinct vertices, as in MeshDefects.
  uint64_t boundaryEdgeCount = 0;
  uint64_t nonManifoldEdgeCount = 0;   ///< Edges of more than two faces.
  uint64_t inconsistentEdgeCount = 0;  ///< Edges whose two faces traverse them in the same direction.
  /// Every face has finite corners and three distinct vertices, and each edge exactly two faces.
  bool isClosed = false;
};

/// Precondition: every index of a face is below the vertex count. Throws Error{Input} where there are more than
/// 2^32 - 1 edges or arcs.
[[nodiscard]] EdgeSurvey surveyEdges(const TriangleMesh& mesh);

}  // namespace asdfvk
