#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/vec3.h"
#include "mesh/mesh.h"

namespace asdfvk::test {

/// Judges the thickness and shares no code with it: the shrinking ball of Ma, Bae and Choi 2012 as it is published, in
/// the coordinates of the mesh, with nearest points among all faces.
class BruteForceThickness {
 public:
  /// cosine: greatest one between the normals of a face and of its opposing walls.
  BruteForceThickness(const TriangleMesh& mesh, double cosine) : mesh_(mesh), cosine_(cosine) {
    for (const Face& face : mesh.faces) {
      const auto [a, b, c] = cornersOf(face);
      const Vec3d product = cross(b - a, c - a);
      normals_.push_back(length(product) > 0 ? product / length(product) : Vec3d{});
    }
  }

  [[nodiscard]] bool isOpposing(uint32_t face, uint32_t wall) const {
    return length(normals_[wall]) > 0 && dot(normals_[face], normals_[wall]) <= cosine_;
  }

  /// The diameter of the largest ball at the barycentre of the face, at most `start`. Faces with the corners of the
  /// face are no walls.
  [[nodiscard]] double of(uint32_t face, double start) const {
    const auto [a, b, c] = cornersOf(mesh_.faces[face]);
    const Vec3d origin = (a + b + c) / 3.0, axis = -normals_[face];
    std::vector<uint32_t> walls;
    for (uint32_t wall = 0; wall < mesh_.faceCount(); ++wall)
      if (isOpposing(face, wall) && !isCopy(face, wall)) walls.push_back(wall);
    double diameter = start;
    for (int step = 0; step < 200; ++step) {
      const Vec3d centre = origin + 0.5 * diameter * axis;
      double nearest = std::numeric_limits<double>::infinity();
      Vec3d point;
      for (const uint32_t wall : walls) {
        const Vec3d p = nearestPoint(cornersOf(mesh_.faces[wall]), centre);
        if (length(p - centre) >= nearest) continue;
        nearest = length(p - centre);
        point = p;
      }
      if (nearest >= 0.5 * diameter * (1 - 1e-12)) break;
      const Vec3d v = point - origin;
      if (dot(v, axis) <= 0) return 0;  // The barycentre is on a wall, up to rounding.
      diameter = dot(v, v) / dot(v, axis);
    }
    return diameter;
  }

 private:
  using Corners = std::array<Vec3d, 3>;

  [[nodiscard]] Corners cornersOf(const Face& face) const {
    return {mesh_.vertices[face[0]], mesh_.vertices[face[1]], mesh_.vertices[face[2]]};
  }

  [[nodiscard]] bool isCopy(uint32_t face, uint32_t wall) const {
    const Corners a = cornersOf(mesh_.faces[face]), b = cornersOf(mesh_.faces[wall]);
    return std::is_permutation(a.begin(), a.end(), b.begin());
  }

  static Vec3d nearestOnSegment(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
    const double square = dot(b - a, b - a);
    return square > 0 ? a + std::clamp(dot(p - a, b - a) / square, 0.0, 1.0) * (b - a) : a;
  }

  static Vec3d nearestPoint(const Corners& t, const Vec3d& p) {
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const Vec3d projected = p - (dot(p - t[0], normal) / dot(normal, normal)) * normal;
    bool isInside = true;
    Vec3d nearest = t[0];
    for (size_t i = 0; i < 3; ++i) {
      const Vec3d &a = t[i], &b = t[(i + 1) % 3];
      isInside = isInside && dot(cross(b - a, projected - a), normal) >= 0;
      const Vec3d onEdge = nearestOnSegment(a, b, p);
      if (length(onEdge - p) < length(nearest - p)) nearest = onEdge;
    }
    return isInside ? projected : nearest;
  }

  TriangleMesh mesh_;
  double cosine_;
  std::vector<Vec3d> normals_;
};

}  // namespace asdfvk::test
