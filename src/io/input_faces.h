#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Collects the faces of a file in file order, with any corner counts, and triangulates them when all vertices are
/// read. Stores plain triangles until the first face that is not a triangle.
class InputFaces {
 public:
  /// Precondition: the caller has checked the count against the size of the file.
  void reserve(uint64_t faceCount);
  void add(std::span<const uint32_t> corners);
  void addTriangles(std::vector<Face>&& triangles);
  [[nodiscard]] uint64_t count() const {
    return polygons_.isEmpty() ? triangles_.size() : polygons_.firstCorner.size() - 1;
  }

  /// Sets mesh.faces and mesh.polygons. Preconditions: mesh.vertices is complete and every corner is below its size.
  /// Throws Error{UnreadableInput} where there are no faces or none has three corners, Error{MeshTooLarge} for more
  /// than 2^32 - 1 faces or triangles.
  void moveTo(Mesh& mesh) { moveTo(mesh.vertices, mesh); }
  void moveTo(std::span<const Vec3d> vertices, Mesh& mesh);

 private:
  void beginPolygons();

  std::vector<Face> triangles_;  ///< Until the first face that is not a triangle.
  Polygons polygons_;            ///< From then on.
};

/// Throws Error{MeshTooLarge} for more than 2^32 - 1 vertices.
void requireIndexableVertexCount(uint64_t count);

}  // namespace asdfvk
