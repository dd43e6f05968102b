#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Takes the faces of a file in its order, whatever their corner counts, and makes triangles of them at the end, when
/// all vertices are known. While every face is a triangle only Mesh::faces is filled.
class InputFaces {
 public:
  /// Room for that many faces. The caller has held the count against the size of the file.
  void reserve(uint64_t faceCount);
  void add(std::span<const uint32_t> corners);
  /// Takes all of `triangles`.
  void addTriangles(std::vector<Face>&& triangles);
  [[nodiscard]] uint64_t count() const {
    return polygons_.isEmpty() ? triangles_.size() : polygons_.firstCorner.size() - 1;
  }

  /// Sets mesh.faces and mesh.polygons. Preconditions: mesh.vertices is complete and every corner is below its size.
  /// Throws Error{Input} where there are no faces, none has three corners, or they make more triangles than 32-bit
  /// indices can count.
  void moveTo(Mesh& mesh);

 private:
  void beginPolygons();

  std::vector<Face> triangles_;  ///< Until the first face that is not a triangle.
  Polygons polygons_;            ///< From then on.
};

/// Throws Error{Input} unless `count` vertices can have 32-bit indices.
void requireIndexableVertexCount(uint64_t count);

}  // namespace asdfvk
