#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Greatest angle between the normals of two faces across which normals are smoothed.
inline constexpr double kCreaseAngleDegrees = 40;

/// #F: unit normals at the three corners of each face. The normal at a corner is the sum of the normals of the faces
/// around the vertex, weighted by their angles there. Only normals within kCreaseAngleDegrees of the normal of the face
/// are added; normals of faces of opposite winding are reversed first. Vertices of very many faces (the hub of a fan)
/// are not smoothed. Zero for a degenerate face.
[[nodiscard]] std::vector<std::array<Vec3d, 3>> cornerNormals(const TriangleMesh& mesh, const FaceGeometry& geometry);

}  // namespace asdfvk
