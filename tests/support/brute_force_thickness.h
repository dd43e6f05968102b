#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/vec3.h"
#include "mesh/mesh.h"

namespace asdfvk::test {

/// Judges the thickness and shares no code with it: all pairs of triangles, in double, in the coordinates of the mesh.
/// A ball of diameter T at some point of a face contains a point of a wall if the face, shifted by T / 2 inwards, is
/// nearer than T / 2 to the wall; the nearest points give the next T, until none is inside.
class BruteForceThickness {
 public:
  /// cosine: greatest one between the normals of a face and of its opposing walls. minDepth: walls begin there, below
  /// the plane of the face.
  BruteForceThickness(const TriangleMesh& mesh, double cosine, double minDepth)
      : mesh_(mesh), cosine_(cosine), minDepth_(minDepth) {
    for (const Face& face : mesh.faces) {
      const auto [a, b, c] = cornersOf(face);
      const Vec3d product = cross(b - a, c - a);
      normals_.push_back(length(product) > 0 ? product / length(product) : Vec3d{});
    }
  }

  [[nodiscard]] bool isOpposing(uint32_t face, uint32_t wall) const {
    return length(normals_[wall]) > 0 && dot(normals_[face], normals_[wall]) <= cosine_;
  }

  /// The largest diameter at the barycentre of the face; infinity where nothing opposes. Faces with the corners of the
  /// face are no walls.
  [[nodiscard]] double at(uint32_t face) const {
    const auto [a, b, c] = cornersOf(mesh_.faces[face]);
    const Vec3d barycentre = (a + b + c) / 3.0;
    return shrink(face, {&barycentre, 1});
  }

  /// The least of these diameters over all points of the face.
  [[nodiscard]] double least(uint32_t face) const { return shrink(face, cornersOf(mesh_.faces[face])); }

 private:
  using Corners = std::array<Vec3d, 3>;
  using Pair = std::pair<Vec3d, Vec3d>;
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  [[nodiscard]] double shrink(uint32_t face, std::span<const Vec3d> base) const {
    double diameter = kInfinity;
    for (uint32_t wall = 0; wall < mesh_.faceCount(); ++wall) {
      if (!isOpposing(face, wall) || isCopy(face, wall)) continue;
      const std::vector<Vec3d> deep = deepPart(cornersOf(mesh_.faces[wall]), base[0], -normals_[face]);
      for (size_t i = 2; i < deep.size(); ++i)
        diameter = shrinkTo({deep[0], deep[i - 1], deep[i]}, base, -normals_[face], diameter);
    }
    return diameter;
  }

  static double shrinkTo(const Corners& wall, std::span<const Vec3d> base, const Vec3d& axis, double diameter) {
    for (const Vec3d& p : base)
      for (const Vec3d& q : wall) diameter = std::min(diameter, dot(q - p, q - p) / dot(q - p, axis));
    for (int step = 0; step < 100; ++step) {
      const Vec3d shift = 0.5 * diameter * axis;
      const auto [p, q] = nearestPair(base, shift, wall);
      if (length(q - p) >= 0.5 * diameter * (1 - 1e-14)) break;
      const Vec3d v = q - (p - shift);
      const double next = dot(v, v) / dot(v, axis);
      if (next >= diameter) break;
      diameter = next;
    }
    return diameter;
  }

  /// The nearest points of the shifted base and of the wall.
  static Pair nearestPair(std::span<const Vec3d> base, const Vec3d& shift, const Corners& wall) {
    Pair best{base[0] + shift, nearestPoint(wall, base[0] + shift)};
    const auto offer = [&](const Vec3d& p, const Vec3d& q) {
      if (length(q - p) < length(best.second - best.first)) best = {p, q};
    };
    if (base.size() == 1) return best;
    const Corners face{base[0] + shift, base[1] + shift, base[2] + shift};
    for (size_t i = 0; i < 3; ++i) {
      offer(face[i], nearestPoint(wall, face[i]));
      offer(nearestPoint(face, wall[i]), wall[i]);
      for (size_t j = 0; j < 3; ++j) {
        const auto [p, q] = nearestOnSegments(face[i], face[(i + 1) % 3], wall[j], wall[(j + 1) % 3]);
        offer(p, q);
      }
      if (const auto hit = crossing(face[i], face[(i + 1) % 3], wall)) offer(*hit, *hit);
      if (const auto hit = crossing(wall[i], wall[(i + 1) % 3], face)) offer(*hit, *hit);
    }
    return best;
  }

  /// Where a segment passes through a triangle.
  static std::optional<Vec3d> crossing(const Vec3d& a, const Vec3d& b, const Corners& t) {
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const double from = dot(a - t[0], normal), to = dot(b - t[0], normal);
    if (from * to > 0 || from == to) return {};
    const Vec3d point = a + from / (from - to) * (b - a);
    for (size_t i = 0; i < 3; ++i)
      if (dot(cross(t[(i + 1) % 3] - t[i], point - t[i]), normal) < 0) return {};
    return point;
  }

  static Pair nearestOnSegments(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const Vec3d u = b - a, v = d - c, w = a - c;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double determinant = uu * vv - uv * uv;
    const double s = determinant > 0 ? std::clamp((uv * vw - vv * uw) / determinant, 0.0, 1.0) : 0;
    const Vec3d p = a + s * u, q = nearestOnSegment(c, d, p);
    return {nearestOnSegment(a, b, q), q};
  }

  /// The corners of the part of a triangle that is deep enough.
  [[nodiscard]] std::vector<Vec3d> deepPart(const Corners& wall, const Vec3d& origin, const Vec3d& axis) const {
    std::vector<Vec3d> part;
    for (size_t i = 0; i < 3; ++i) {
      const Vec3d &a = wall[i], &b = wall[(i + 1) % 3];
      const double from = dot(a - origin, axis) - minDepth_, to = dot(b - origin, axis) - minDepth_;
      if (from > 0) part.push_back(a);
      if ((from > 0) != (to > 0)) part.push_back(a + from / (from - to) * (b - a));
    }
    return part;
  }

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
  double cosine_, minDepth_;
  std::vector<Vec3d> normals_;
};

}  // namespace asdfvk::test
