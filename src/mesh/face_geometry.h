#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/box3.h"
#include "core/simd.h"
#include "core/unset_vector.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A face is degenerate if its height over its longest edge is below this share of that edge. Such a face has no
/// reliable normal.
inline constexpr double kDegenerateHeightRatio = 1e-10;

/// Geometry of the faces, #F entries each, in the unit of the mesh.
struct FaceGeometry {
  UnsetVector<Vec3d> barycentres;  ///< A barycentre is finite only if all corners are finite.
  /// Unit vectors by the right-hand rule over the order of the corners; zero for a degenerate face.
  UnsetVector<Vec3d> normals;
  UnsetVector<double> areas;  ///< 0 for a degenerate face.
  Box3d bounds;               ///< Bounding box of the finite vertices that faces use.

  /// Whether the face has zero area (see kDegenerateHeightRatio) or a non-finite corner. Such a face neither casts rays
  /// nor is hit by rays.
  [[nodiscard]] bool isDegenerate(uint32_t face) const { return areas[face] == 0; }
};

/// Precondition: every index of a face is below the vertex count.
[[nodiscard]] FaceGeometry computeFaceGeometry(const TriangleMesh& mesh,
                                               InstructionSet instructionSet = widestInstructionSet());

/// The box of the vertices with finite coordinates, whether faces use them or not.
[[nodiscard]] Box3d boundsOfFiniteVertices(const TriangleMesh& mesh);

/// Faces closer to each other than this distance are in contact. Unit: half of the longest side of the bounding box.
/// Coordinates in float32 cannot resolve such a distance. The distance also exceeds the rounding errors of touching
/// parts that were rotated.
inline constexpr double kContactDistance = 0x1p-20;

/// Maps the centre of the bounding box of the mesh to the origin and its longest side to a length of 2. Normalised
/// coordinates in float32, and results computed from them, are the same in every unit of the mesh, up to rounding in
/// double.
struct Normalization {
  Vec3d centre;
  double scale = 1;  ///< Normalised units per mesh unit.

  [[nodiscard]] Vec3d toNormalized(const Vec3d& p) const { return (p - centre) * scale; }
  /// The inverse of toNormalized().
  [[nodiscard]] Vec3d toMesh(const Vec3d& normalized) const { return normalized / scale + centre; }
  [[nodiscard]] std::array<Vec3d, 3> normalizedCorners(const TriangleMesh& mesh, uint32_t face) const {
    const auto [a, b, c] = mesh.faces[face];
    return {toNormalized(mesh.vertices[a]), toNormalized(mesh.vertices[b]), toNormalized(mesh.vertices[c])};
  }
  /// Clamped to the largest double, which only the lengths of a mesh as wide as the range of double exceed.
  [[nodiscard]] double toMeshLength(double normalizedLength) const {
    return std::min(normalizedLength / scale, std::numeric_limits<double>::max());
  }
  /// kContactDistance in the unit of the mesh.
  [[nodiscard]] double contactLength() const { return toMeshLength(kContactDistance); }
};

[[nodiscard]] Normalization normalizationOf(const Box3d& bounds);

[[nodiscard]] inline double triangleArea(const std::array<Vec3d, 3>& corners) {
  return 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
}

}  // namespace asdfvk
