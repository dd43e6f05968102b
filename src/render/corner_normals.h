#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Faces that meet at a sharper angle than this are shaded apart.
inline constexpr double kCreaseAngleDegrees = 40;

/// #F unit normals at each face's three corners: those of the vertex's faces that lie within kCreaseAngleDegrees of the
/// face, added up by their angles at the vertex. A face whose winding contradicts is turned over for it. A vertex of
/// very many faces, the hub of a fan, smooths nothing. Those of a degenerate face are zero.
[[nodiscard]] std::vector<std::array<Vec3d, 3>> cornerNormals(const TriangleMesh& mesh, const FaceGeometry& geometry);

}  // namespace asdfvk
