#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Discrete Gaussian curvature of each vertex: its angle defect in radians, 2 pi minus the sum of the angles of its
/// faces, or pi minus the sum at a boundary vertex (Meyer, Desbrun, Schroeder and Barr 2003, not divided by an area).
/// #V; 0 for a vertex without faces. Over a closed mesh the sum is 2 pi times the Euler characteristic.
///
/// A face of zero area contributes the limits of its angles, which sum to pi: 0, 0 and pi for collinear corners; 0,
/// pi/2 and pi/2 if two corners coincide; pi/3 each if all three coincide. A face with a repeated vertex or a
/// non-finite corner contributes no angles. Precondition: every index of a face is below the vertex count.
[[nodiscard]] std::vector<double> vertexAngleDefects(const TriangleMesh& mesh);

/// #F: the mean of the angle defects of the three vertices of a face.
[[nodiscard]] std::vector<double> faceCurvature(const TriangleMesh& mesh);

}  // namespace asdfvk
