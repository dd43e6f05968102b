#pragma once

#include <cstdint>

#include "mesh/dual_graph.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// What one pass over the edges of a mesh tells.
struct EdgeSurvey {
  DualGraph graph;  ///< See buildDualGraph().
  // Of the triangles with finite corners and three distinct vertices, as in MeshDefects.
  uint64_t boundaryEdgeCount = 0;
  uint64_t nonManifoldEdgeCount = 0;   ///< Of more than two faces.
  uint64_t inconsistentEdgeCount = 0;  ///< Whose two faces run through them in the same direction.
  /// Every face has finite corners and three distinct vertices, and each edge exactly two of them.
  bool isClosed = false;
};

/// Precondition: every index of a face is below the vertex count. Throws Error{Input} where there are more than
/// 2^32 - 1 edges or arcs.
[[nodiscard]] EdgeSurvey surveyEdges(const TriangleMesh& mesh);

}  // namespace asdfvk
