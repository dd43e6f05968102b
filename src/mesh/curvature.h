#pragma once

#include <cstdint>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The angle in radians between the normals of two neighbouring faces: 0 for coplanar faces, up to pi for faces folded
/// onto each other, positive on a concave edge, negative on a convex edge. An edge is concave where the barycentre of
/// each face is in front of the plane of the other; an edge between faces of opposite winding is never concave. 0 where
/// a face is degenerate. The result has the same bits if the faces are swapped.
[[nodiscard]] double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g);

/// Discrete Gaussian curvature of each vertex: its angle defect in radians, 2 pi minus the sum of the angles of its
/// faces, or pi minus the sum at a boundary vertex (Meyer, Desbrun, Schroeder and Barr 2003, not divided by an area).
/// #V; 0 for a vertex without faces. Over a closed mesh the sum is 2 pi times the Euler characteristic.
///
/// A face of zero area contributes the limits of its angles, which sum to pi: 0, 0 and pi for collinear corners; 0,
/// pi/2 and pi/2 where two corners coincide; pi/3 each where all coincide. A face with a repeated vertex or a
/// non-finite corner contributes none. Precondition: every index of a face is below the vertex count.
[[nodiscard]] std::vector<double> vertexAngleDefects(const TriangleMesh& mesh);

/// #F: the mean of the angle defects of the three vertices of a face.
[[nodiscard]] std::vector<double> faceCurvature(const TriangleMesh& mesh);

}  // namespace asdfvk
