#pragma once

#include <cstdint>
#include <vector>

#include "mesh/edge_survey.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A set of faces connected in the dual graph.
struct Component {
  uint32_t firstFace = 0;  ///< Its lowest face.
  uint32_t faceCount = 0;
  bool isClosed = false;  ///< Each edge has exactly two faces; triangles with a repeated vertex do not count.
  bool isConsistentlyWound = false;  ///< The two faces of each such edge traverse it in opposite directions.
  double signedVolume = 0;           ///< In mesh units cubed; negative where faces look inwards, 0 where rounding hides
                                     ///< the sign. Valid for closed, consistently wound components only.
};

struct Components {
  std::vector<uint32_t> componentOf;  ///< #F
  std::vector<Component> components;  ///< By lowest face.
};

/// Precondition: no index is out of range, and `graph` is that of the mesh. A face with a non-finite corner is a
/// component of its own; the hole that it leaves makes the component around it open.
[[nodiscard]] Components findComponents(const TriangleMesh& mesh, const DualGraph& graph);

/// The same; faster where the mesh has no open edge.
[[nodiscard]] Components findComponents(const TriangleMesh& mesh, const EdgeSurvey& edges);

}  // namespace asdfvk
