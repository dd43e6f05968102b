#pragma once

#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// The angle in radians between the normals of two neighbouring faces: 0 where they lie in one plane, up to pi where
/// they are folded onto each other, positive on a concave edge and negative on a convex one. An edge is concave where
/// the barycentre of each face is in front of the plane of the other; edges of opposite winding are not. 0 where a face
/// is degenerate. The same bits when the faces are swapped.
[[nodiscard]] double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g);

/// For the two faces of each arc, in the order of graph.neighbours.
[[nodiscard]] std::vector<double> signedDihedralAngles(const DualGraph& graph, const FaceGeometry& geometry);

}  // namespace asdfvk
