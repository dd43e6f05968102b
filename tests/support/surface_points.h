#pragma once

#include <vector>

#include "asdf_vk/mesh.h"

namespace asdfvk::test {

/// Points with normals, as arrays of a caller.
struct SurfacePoints {
  std::vector<double> points, normals;

  void add(const Vec3d& point, const Vec3d& normal) {
    points.insert(points.end(), {point.x, point.y, point.z});
    normals.insert(normals.end(), {normal.x, normal.y, normal.z});
  }
  [[nodiscard]] Vec3d point(size_t i) const { return {points[3 * i], points[3 * i + 1], points[3 * i + 2]}; }
  [[nodiscard]] Vec3d normal(size_t i) const { return {normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]}; }
  [[nodiscard]] size_t size() const { return points.size() / 3; }
};

/// With normals of other lengths than 1.
inline SurfacePoints barycentresOf(const Mesh& mesh) {
  SurfacePoints result;
  for (const auto [a, b, c] : mesh.faces) {
    const Vec3d &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    result.add((p + q + r) / 3.0, cross(q - p, r - p));
  }
  return result;
}

}  // namespace asdfvk::test
