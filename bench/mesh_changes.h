#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "asdf_vk/mesh.h"

namespace asdfvk::bench {

/// A mesh after a change that leaves its shape nearly the same.
struct ChangedMesh {
  Mesh mesh;
  /// #F of the changed mesh: the face of the original mesh; empty if faces have no such origin.
  std::vector<uint32_t> originalFaces;
};

// The changes are deterministic. Coordinates are in the unit of the mesh.

[[nodiscard]] ChangedMesh unchanged(const Mesh& mesh);
/// Moves each vertex by normally distributed offsets. share: standard deviation per axis, divided by the diagonal of
/// the bounding box.
[[nodiscard]] ChangedMesh addNoise(const Mesh& mesh, double share);
[[nodiscard]] ChangedMesh turn(const Mesh& mesh);
/// Divides each face into four at the midpoints of its edges.
[[nodiscard]] ChangedMesh divideFaces(const Mesh& mesh);
/// Removes edges of least quadric error (Garland and Heckbert 1997) until `share` of the faces remain.
[[nodiscard]] ChangedMesh decimate(const Mesh& mesh, double share);
/// Replaces edges by the other diagonal of their two faces, where the faces are nearly in one plane.
[[nodiscard]] ChangedMesh flipEdges(const Mesh& mesh);
/// Removes the faces in `count` balls. radiusShare: radius, divided by the diagonal of the bounding box.
[[nodiscard]] ChangedMesh removeDiscs(const Mesh& mesh, uint32_t count, double radiusShare);

}  // namespace asdfvk::bench
