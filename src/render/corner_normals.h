#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Normals are smoothed across an edge if the normals of its two faces differ by at most this angle.
inline constexpr double kCreaseAngleDegrees = 40;

/// #F: unit normals at the three corners of each face; zero for a degenerate face. A corner has the sum of the normals
/// of the faces around its vertex, weighted by the angles of these faces at the vertex. The sum has only normals within
/// kCreaseAngleDegrees of the normal of the face. Normals of faces of opposite winding are reversed first. Vertices of
/// very many faces, for example the hub of a fan, are not smoothed.
[[nodiscard]] std::vector<std::array<Vec3d, 3>> cornerNormals(const TriangleMesh& mesh, const FaceGeometry& geometry);

}  // namespace asdfvk
