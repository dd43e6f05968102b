#pragma once

#include <cstdint>
#include <vector>

#include "core/box3.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A face whose height over its longest edge is below this share of that edge is degenerate: it has no reliable normal.
inline constexpr double kDegenerateHeightRatio = 1e-10;

/// Per face quantities, #F each, in the mesh's unit.
struct FaceGeometry {
  std::vector<Vec3d> barycentres;  ///< Non-finite where a corner is.
  std::vector<Vec3d> normals;      ///< Unit, right-hand rule over the file's vertex order; zero for a degenerate face.
  std::vector<double> areas;       ///< 0 for a degenerate face.
  Box3d bounds;                    ///< Box of the finite vertices that faces use.

  /// Zero area (up to kDegenerateHeightRatio) or a non-finite corner: neither casts rays nor is hit by them.
  [[nodiscard]] bool isDegenerate(uint32_t face) const { return areas[face] == 0; }
};

/// Precondition: every index of a face is below the vertex count.
[[nodiscard]] FaceGeometry computeFaceGeometry(const TriangleMesh& mesh);

}  // namespace asdfvk
