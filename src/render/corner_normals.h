#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Normals are not smoothed between faces with a larger angle between their normals.
inline constexpr double kCreaseAngleDegrees = 40;

/// #F unit normals at the three corners of each face: the sum of the normals of the faces at the vertex that are within
/// kCreaseAngleDegrees of this face, weighted by their angles at the vertex. Normals of opposite winding are reversed.
/// Vertices of very many faces (the hub of a fan) are not smoothed. Zero for a degenerate face.
[[nodiscard]] std::vector<std::array<Vec3d, 3>> cornerNormals(const TriangleMesh& mesh, const FaceGeometry& geometry);

}  // namespace asdfvk
