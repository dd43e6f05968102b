#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/point2.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Collects the faces of a file in file order, with any numbers of corners. Triangulates the faces when all vertices
/// are read. Stores plain triangles until the first face that is not a triangle.
class InputFaces {
 public:
  /// Precondition: the caller has checked the count against the size of the file.
  void reserve(uint64_t faceCount);
  void add(std::span<const uint32_t> corners);
  void addTriangles(std::vector<Face>&& triangles);
  [[nodiscard]] uint64_t count() const {
    return polygons_.isEmpty() ? triangles_.size() : polygons_.firstCorner.size() - 1;
  }

  /// Sets mesh.faces and mesh.polygons. Preconditions: mesh.vertices is complete and every corner is below the vertex
  /// count. Throws Error{UnreadableInput} if no face has three corners, Error{MeshTooLarge} for more than 2^32 - 1
  /// faces or triangles.
  void moveTo(Mesh& mesh) { moveTo(mesh.vertices, mesh); }
  void moveTo(std::span<const Vec3d> vertices, Mesh& mesh);

 private:
  void beginPolygons();

  std::vector<Face> triangles_;  ///< All faces, as long as all of them are triangles.
  Polygons polygons_;            ///< All faces, after the first one that is not a triangle.
};

/// Concave polygons with more corners than this are cut into a fan, because the time of ear clipping is quadratic in
/// the corner count. The fan may overlap itself.
inline constexpr size_t kMaxEarClippedCorners = 1000;

/// Cuts polygons into triangles of the same winding. Reuses its working memory.
class PolygonTriangulator {
 public:
  /// Fills all n - 2 `triangles` of a polygon with n >= 3 corners, degenerate triangles included. A polygon with a left
  /// turn at every corner becomes the fan of its first corner. Any other polygon is cut by ear clipping (Meisters
  /// 1975), in the coordinate plane closest to its Newell normal. Straight corners are clipped last, which avoids empty
  /// triangles where possible. A polygon with non-finite corners or without area becomes the fan. Precondition: every
  /// corner is below the vertex count.
  void triangulate(std::span<const Vec3d> vertices, std::span<const uint32_t> corners, std::span<Face> triangles);

 private:
  /// Projects the corners into points_. Returns false if the polygon spans no plane.
  [[nodiscard]] bool project(std::span<const Vec3d> vertices, std::span<const uint32_t> corners);
  [[nodiscard]] double turnAt(uint32_t corner) const;
  [[nodiscard]] bool isEar(uint32_t corner) const;
  [[nodiscard]] uint32_t findEar(uint32_t start, size_t leftCount) const;
  void clipEars(std::span<const uint32_t> corners, std::span<Face> triangles);

  // Arrays with an entry per corner of the current polygon. previous_ and next_ link the corners that are not yet
  // clipped to a ring.
  std::vector<Point2> points_;
  std::vector<uint32_t> previous_, next_;
  std::vector<double> turn_;
  std::vector<uint8_t> isEar_, isClipped_;
  /// Corners that are not left turns of the whole polygon; only these can lie in an ear.
  std::vector<uint32_t> reflex_;
};

}  // namespace asdfvk
