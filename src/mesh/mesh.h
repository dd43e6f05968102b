#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "asdf_vk/mesh.h"
#include "core/vec3.h"

namespace asdfvk {

/// Greatest number of vertices and of input faces. Indices have 32 bits, and the greatest index means "none".
inline constexpr uint64_t kMaxIndexCount = std::numeric_limits<uint32_t>::max();
/// Greatest number of triangles. The numbers of all corners, three per triangle, must fit into 32 bits.
inline constexpr uint64_t kMaxTriangleCount = kMaxIndexCount / 3;

/// Throws Error{MeshTooLarge} if count > limit. plural: the counted elements, for example "triangles".
void requireAtMost(uint64_t limit, uint64_t count, const char* plural);

/// Whether the three vertices of the face differ; independent of the coordinates.
[[nodiscard]] constexpr bool hasDistinctVertices(const Face& face) {
  return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

/// A view of Polygons.
struct PolygonsView {
  std::span<const uint64_t> firstCorner;
  std::span<const uint32_t> corners;
  std::span<const uint32_t> inputFaceOf;

  [[nodiscard]] bool isEmpty() const { return firstCorner.empty(); }
};

/// The mesh type of all algorithms: a view of triangles and of the input faces that they were cut from. The arrays must
/// outlive the view.
struct TriangleMesh {
  std::span<const Vec3d> vertices;  ///< #V; may hold non-finite numbers.
  std::span<const Face> faces;      ///< #F
  PolygonsView polygons;            ///< Empty if every input face is one triangle.

  TriangleMesh() = default;
  TriangleMesh(const Mesh& mesh)  // NOLINT: implicit by design
      : vertices(mesh.vertices),
        faces(mesh.faces),
        polygons{mesh.polygons.firstCorner, mesh.polygons.corners, mesh.polygons.inputFaceOf} {}

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(faces.size()); }
  /// Precondition: the indices of the face are below the vertex count.
  [[nodiscard]] bool hasFiniteCorners(uint32_t face) const {
    const auto [a, b, c] = faces[face];
    return isFinite(vertices[a]) && isFinite(vertices[b]) && isFinite(vertices[c]);
  }
  /// The input face that a triangle was cut from.
  [[nodiscard]] uint32_t inputFaceOf(uint32_t face) const {
    return polygons.isEmpty() ? face : polygons.inputFaceOf[face];
  }
  /// The number of input faces, #I.
  [[nodiscard]] uint64_t inputFaceCount() const {
    return polygons.isEmpty() ? faces.size() : polygons.firstCorner.size() - 1;
  }
};

}  // namespace asdfvk
