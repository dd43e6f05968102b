#include "mesh/face_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lane_vec3.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

struct NormalAndArea {
  Vec3d normal;
  double area = 0;
};

// Differences of any two coordinates, multiplied by this factor, can be added in pairs without overflow.
constexpr double kQuarter = 0.25;

template <typename Vector>
ASDFVK_ALWAYS_INLINE inline Vector quarterOf(const Vector& from, const Vector& to) {
  return to * kQuarter - from * kQuarter;
}

template <typename Vector>
ASDFVK_ALWAYS_INLINE inline Vector barycentreOf(const Vector& a, const Vector& b, const Vector& c) {
  return (a * kQuarter + (quarterOf(a, b) + quarterOf(a, c)) / 3.0) * (1 / kQuarter);
}

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

void computeOne(const TriangleMesh& mesh, size_t face, FaceGeometry& geometry, Box3d& bounds) {
  const auto [i, j, k] = mesh.faces[face];
  const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
  geometry.barycentres[face] = barycentreOf(a, b, c);
  bool isFiniteFace = true;
  for (const Vec3d* corner : {&a, &b, &c}) {
    if (isFinite(*corner)) {
      bounds.add(*corner);
    } else {
      isFiniteFace = false;
    }
  }
  const NormalAndArea ofFace = isFiniteFace ? normalAndArea(a, b, c) : NormalAndArea{};
  geometry.normals[face] = ofFace.normal;
  geometry.areas[face] = ofFace.area;
}

constexpr size_t kLanes = kLaneCount<Double4>;

/// A box per lane.
class LaneBox {
 public:
  ASDFVK_ALWAYS_INLINE void add(const Vec3Double4& p) {
    min_ = {min(p.x, min_.x), min(p.y, min_.y), min(p.z, min_.z)};
    max_ = {max(p.x, max_.x), max(p.y, max_.y), max(p.z, max_.z)};
  }
  ASDFVK_ALWAYS_INLINE void addTo(Box3d& box) const {
    for (size_t lane = 0; lane < kLanes; ++lane)
      box.add(Box3d{{min_.x[lane], min_.y[lane], min_.z[lane]}, {max_.x[lane], max_.y[lane], max_.z[lane]}});
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  Vec3Double4 min_ = {broadcast<Double4>(kInfinity), broadcast<Double4>(kInfinity), broadcast<Double4>(kInfinity)};
  Vec3Double4 max_ = {broadcast<Double4>(-kInfinity), broadcast<Double4>(-kInfinity), broadcast<Double4>(-kInfinity)};
};

/// The sum of the absolute coordinates.
ASDFVK_ALWAYS_INLINE inline Double4 l1Norm(const Vec3Double4& v) {
  const auto absolute = [](const Double4& x) ASDFVK_ALWAYS_INLINE { return x < 0 ? -x : x; };
  return absolute(v.x) + absolute(v.y) + absolute(v.z);
}

/// computeOne() for four faces. Returns false, and does nothing, unless the edges of all four faces are finite and of
/// ordinary length.
ASDFVK_ALWAYS_INLINE inline bool computeFour(const TriangleMesh& mesh, size_t first, FaceGeometry& geometry,
                                             LaneBox& box) {
  LaneIndices corners[3];
  for (size_t lane = 0; lane < kLanes; ++lane)
    for (size_t k = 0; k < 3; ++k) corners[k][lane] = mesh.faces[first + lane][k];
  const Vec3Double4 a = gather(mesh.vertices.data(), corners[0]), b = gather(mesh.vertices.data(), corners[1]),
                    c = gather(mesh.vertices.data(), corners[2]);
  const Vec3Double4 ab = quarterOf(a, b), ac = quarterOf(a, c), bc = quarterOf(b, c);
  // The sum is at least the greatest absolute coordinate, and at most nine times as large. It is NaN or infinite if a
  // corner is not finite.
  const Double4 norm = l1Norm(ab) + l1Norm(ac) + l1Norm(bc);
  if (anyLane(~((norm > 16 * kLeastLength) & (norm < kGreatestLength)))) return false;
  const Vec3Double4 normal = cross(ab, ac);
  const Double4 doubledArea = squareRoots(dot(normal, normal));
  const auto isFaceWithArea = doubledArea > kDegenerateHeightRatio * max(max(dot(ab, ab), dot(ac, ac)), dot(bc, bc));
  const auto unit = [&](const Double4& x) ASDFVK_ALWAYS_INLINE { return isFaceWithArea ? x / doubledArea : Double4{}; };
  storeVectors(&geometry.normals[first], {unit(normal.x), unit(normal.y), unit(normal.z)});
  storeVectors(&geometry.barycentres[first], barycentreOf(a, b, c));
  store(&geometry.areas[first], (isFaceWithArea ? doubledArea : Double4{}) * (0.5 / (kQuarter * kQuarter)));
  for (const Vec3Double4& corner : {a, b, c}) box.add(corner);
  return true;
}

Box3d joined(Box3d a, const Box3d& b) {
  a.add(b);
  return a;
}

}  // namespace

FaceGeometry computeFaceGeometry(const TriangleMesh& mesh, InstructionSet instructionSet) {
  FaceGeometry geometry;
  const size_t faceCount = mesh.faces.size();
  geometry.barycentres.resize(faceCount);
  geometry.normals.resize(faceCount);
  geometry.areas.resize(faceCount);
  const auto computeRange = [&](size_t begin, size_t end) {
    Box3d bounds;
    dispatch<Float8>(instructionSet, [&]<typename>() ASDFVK_ALWAYS_INLINE {
      LaneBox box;
      for (size_t face = begin; face < end; face += kLanes)
        if (face + kLanes > end || !computeFour(mesh, face, geometry, box))
          for (size_t i = face; i < std::min(face + kLanes, end); ++i) computeOne(mesh, i, geometry, bounds);
      box.addTo(bounds);
    });
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
