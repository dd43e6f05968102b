#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace asdfvk {

/// Three vertex indices, counter-clockwise seen from outside.
using Face = std::array<uint32_t, 3>;

/// Else the face is no more than an edge or a point, whatever its coordinates.
[[nodiscard]] constexpr bool hasDistinctVertices(const Face& face) {
  return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

/// "No value" of a face: a quiet NaN.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The input's faces where not all of them were triangles. Input face i has the corners
/// corners[firstCorner[i]] .. corners[firstCorner[i + 1] - 1], in file order; it may have fewer than three.
struct Polygons {
  std::vector<uint64_t> firstCorner;  ///< #I+1, or empty: every input face is one triangle.
  std::vector<uint32_t> corners;      ///< Vertex indices.
  std::vector<uint32_t> inputFaceOf;  ///< #F: the input face that a triangle was cut from; non-decreasing.

  [[nodiscard]] bool isEmpty() const { return firstCorner.empty(); }
};

/// A triangle mesh as plain arrays: no face is lost, doubled or reordered, whatever its topology.
struct Mesh {
  std::vector<Vec3d> vertices;  ///< #V, in the file's unit; may hold non-finite numbers (see findDefects()).
  std::vector<Face> faces;      ///< #F triangles.
  Polygons polygons;            ///< Set only where an input face was not a triangle.

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(faces.size()); }
  /// Precondition: the face's indices are below the vertex count.
  [[nodiscard]] bool hasFiniteCorners(uint32_t face) const {
    const auto [a, b, c] = faces[face];
    return isFinite(vertices[a]) && isFinite(vertices[b]) && isFinite(vertices[c]);
  }
  /// Which of the file's faces a triangle was cut from.
  [[nodiscard]] uint32_t inputFaceOf(uint32_t face) const {
    return polygons.isEmpty() ? face : polygons.inputFaceOf[face];
  }
  /// #I, what the file calls faces.
  [[nodiscard]] uint64_t inputFaceCount() const {
    return polygons.isEmpty() ? faces.size() : polygons.firstCorner.size() - 1;
  }
};

}  // namespace asdfvk
