#pragma once

#include <cstdint>
#include <vector>

#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A set of faces connected in the dual graph.
struct Component {
  uint32_t firstFace = 0;  ///< The lowest face index.
  uint32_t faceCount = 0;
  bool isClosed = false;             ///< No edge of a proper face is Boundary or Branching (EdgeKind).
  bool isBranching = false;          ///< An edge is Branching.
  bool isConsistentlyWound = false;  ///< No edge is Inconsistent (EdgeKind).
  double signedVolume = 0;           ///< Volume in mesh units cubed; negative if faces point inwards, 0 if the sign is
                            ///< uncertain because of rounding. Valid for closed, consistently wound components only.
};

struct Components {
  UnsetVector<uint32_t> componentOf;  ///< #F
  std::vector<Component> components;  ///< Sorted by their lowest face.
};

/// edges: the survey of the mesh. Precondition: every index of a face is below the vertex count. A face with a
/// non-finite corner is a separate component. The face leaves a hole, so that the component around the hole is open.
[[nodiscard]] Components findComponents(const TriangleMesh& mesh, const EdgeSurvey& edges);

}  // namespace asdfvk
