#include "mesh/face_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace asdfvk {
namespace {

struct NormalAndArea {
  Vec3d normal;
  double area = 0;
};

// Differences of any two coordinates, multiplied by this factor, can be added in pairs without overflow.
constexpr double kQuarter = 0.25;

Vec3d quarterOf(const Vec3d& from, const Vec3d& to) { return to * kQuarter - from * kQuarter; }

// If the longest edge is between these bounds, products of four lengths do not overflow, and underflow only in
// degenerate faces.
constexpr double kLeastLength = 0x1p-200, kGreatestLength = 0x1p200;

// In tiny and huge units, the edges are first divided by a power of two near the longest edge. This division is exact.
NormalAndArea normalAndArea(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  Vec3d ab = quarterOf(a, b), ac = quarterOf(a, c), bc = quarterOf(b, c);
  double longest = 0;
  for (const Vec3d& edge : {ab, ac, bc})
    for (size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, std::abs(edge[axis]));
  if (!(longest > 0)) return {};
  const double unit = longest > kLeastLength && longest < kGreatestLength ? 1 : std::ldexp(1.0, std::ilogb(longest));
  if (unit != 1)
    for (Vec3d* edge : {&ab, &ac, &bc}) *edge = *edge / unit;
  const double longestSquared = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  const Vec3d normal = cross(ab, ac);
  const double doubledArea = length(normal);
  if (!(doubledArea > kDegenerateHeightRatio * longestSquared)) return {};
  // An area beyond the range of double must neither count as degenerate nor become infinite.
  using Limits = std::numeric_limits<double>;
  const double area = 0.5 * doubledArea * (unit / kQuarter) * (unit / kQuarter);
  return {normal / doubledArea, std::clamp(area, Limits::min(), Limits::max())};
}

Box3d joined(Box3d a, const Box3d& b) {
  a.add(b);
  return a;
}

}  // namespace

FaceGeometry computeFaceGeometry(const TriangleMesh& mesh) {
  FaceGeometry geometry;
  const size_t faceCount = mesh.faces.size();
  geometry.barycentres.resize(faceCount);
  geometry.normals.resize(faceCount);
  geometry.areas.resize(faceCount);
  const auto computeRange = [&](size_t begin, size_t end) {
    Box3d bounds;
    for (size_t f = begin; f < end; ++f) {
      const auto [i, j, k] = mesh.faces[f];
      const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
      geometry.barycentres[f] = (a * kQuarter + (quarterOf(a, b) + quarterOf(a, c)) / 3.0) / kQuarter;
      bool isFiniteFace = true;
      for (const Vec3d* corner : {&a, &b, &c}) {
        if (isFinite(*corner)) {
          bounds.add(*corner);
        } else {
          isFiniteFace = false;
        }
      }
      const NormalAndArea face = isFiniteFace ? normalAndArea(a, b, c) : NormalAndArea{};
      geometry.normals[f] = face.normal;
      geometry.areas[f] = face.area;
    }
    return bounds;
  };
  geometry.bounds = foldInParallel<Box3d>(faceCount, computeRange, joined);
  return geometry;
}

Box3d boundsOfFiniteVertices(const TriangleMesh& mesh) {
  const auto boundRange = [&](size_t begin, size_t end) {
    Box3d bounds;
    for (size_t i = begin; i < end; ++i)
      if (isFinite(mesh.vertices[i])) bounds.add(mesh.vertices[i]);
    return bounds;
  };
  return foldInParallel<Box3d>(mesh.vertices.size(), boundRange, joined);
}

Normalization normalizationOf(const Box3d& bounds) {
  const Vec3d halfSize = bounds.halfSize();
  const double halfExtent = std::max({halfSize.x, halfSize.y, halfSize.z});
  Normalization normalization{.centre = bounds.centre()};
  if (!(halfExtent > 0) || !std::isfinite(halfExtent)) return normalization;
  normalization.scale = std::min(1 / halfExtent, std::numeric_limits<double>::max());
  return normalization;
}

}  // namespace asdfvk
