#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Discrete Gaussian curvature of each vertex without a unit, its angle defect: 2 pi minus the angles of the faces
/// around it, or pi minus them where an edge at it has only one face (Meyer, Desbrun, Schroeder and Barr 2003, not
/// divided by an area). #V; 0 for a vertex without faces. Over a closed mesh they sum to 2 pi times its Euler
/// characteristic.
///
/// A face of zero area contributes the angles of the limit that it is, which sum to pi: 0, 0 and pi where its corners
/// are in line, 0, pi/2 and pi/2 where two of them are at one place, pi/3 each where all are. A face with a repeated
/// vertex or a non-finite corner contributes none. Precondition: no index is out of range.
[[nodiscard]] std::vector<double> vertexAngleDefects(const TriangleMesh& mesh);

/// Per face the mean of its three vertices' angle defects. #F
[[nodiscard]] std::vector<double> faceCurvature(const TriangleMesh& mesh);

}  // namespace asdfvk
