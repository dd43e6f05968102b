#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "core/simd.h"
#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// The angle in radians between the normals of two neighbouring faces: 0 for coplanar faces, up to pi for faces folded
/// onto each other, positive on a concave edge, negative on a convex edge. An edge is concave where the barycentre of
/// each face is in front of the plane of the other; an edge between faces of opposite winding is never concave. 0 where
/// a face is degenerate. The result has the same bits if the faces are swapped.
[[nodiscard]] double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g);

/// signedDihedralAngle() of each arc, in the order of graph.neighbours, rounded to float.
[[nodiscard]] UnsetVector<float> arcAngles(const DualGraph& graph, const FaceGeometry& geometry,
                                           InstructionSet instructionSet = widestInstructionSet());

/// The result of arcAngles(), computed at the first use. Samplers and the equation share it. Graph and geometry must
/// outlive this object. Only one thread may use it at a time.
class ArcAngles {
 public:
  ArcAngles(const DualGraph& graph, const FaceGeometry& geometry) : graph_(graph), geometry_(geometry) {}

  [[nodiscard]] std::span<const float> get() {
    if (angles_.empty()) angles_ = arcAngles(graph_, geometry_);
    return angles_;
  }
  /// Like get(), and releases the memory. A later use computes the angles again.
  [[nodiscard]] UnsetVector<float> take() {
    (void)get();
    return std::exchange(angles_, {});
  }

 private:
  const DualGraph& graph_;
  const FaceGeometry& geometry_;
  UnsetVector<float> angles_;
};

}  // namespace asdfvk
