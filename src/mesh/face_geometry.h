#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
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

/// The box of the vertices with finite coordinates, whether faces use them or not.
[[nodiscard]] Box3d boundsOfFiniteVertices(const TriangleMesh& mesh);

/// Faces that are nearer to each other are in contact; in units of half of the longest side of the mesh. Coordinates in
/// float32 cannot resolve such a distance. It also covers the rounding of parts that touch and are rotated.
inline constexpr double kContactDistance = 0x1p-20;

/// Maps the box of the mesh to [-1, 1] along its longest side, around its centre. Coordinates in float32 are the same
/// in every unit of the mesh, up to rounding in double, and so is what is computed from them.
struct Normalization {
  Vec3d centre;
  double scale = 1;  ///< Normalised units per mesh unit.

  [[nodiscard]] Vec3d toNormalized(const Vec3d& p) const { return (p - centre) * scale; }
  /// Clamped to the largest double; only meshes as wide as the range of double need that.
  [[nodiscard]] double toMeshLength(double normalizedLength) const {
    return std::min(normalizedLength / scale, std::numeric_limits<double>::max());
  }
  /// kContactDistance in the unit of the mesh.
  [[nodiscard]] double contactLength() const { return toMeshLength(kContactDistance); }
};

[[nodiscard]] Normalization normalizationOf(const Box3d& bounds);

}  // namespace asdfvk
