#include "mesh/input_faces.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/free_memory.h"
#include "core/parallel.h"
#include "core/text.h"
#include "core/vec3.h"

namespace asdfvk {
namespace {

constexpr uint64_t kPolygonsPerBlock = 4096;

[[noreturn]] void failInput(const std::string& reason) { throw Error(ErrorCode::UnreadableInput, reason); }

void triangulateAll(std::span<const Vec3d> vertices, Polygons& polygons, std::vector<Face>& triangles) {
  const uint64_t polygonCount = polygons.firstCorner.size() - 1;
  const auto cornerCountOf = [&](uint64_t i) { return polygons.firstCorner[i + 1] - polygons.firstCorner[i]; };
  std::vector<uint64_t> firstTriangleOfBlock;
  uint64_t triangleCount = 0;
  for (uint64_t i = 0; i < polygonCount; ++i) {
    if (i % kPolygonsPerBlock == 0) firstTriangleOfBlock.push_back(triangleCount);
    triangleCount += std::max<uint64_t>(cornerCountOf(i), 2) - 2;
  }
  requireAtMost(kMaxIndexCount, polygonCount, "faces");
  requireAtMost(kMaxTriangleCount, triangleCount, "triangles");
  triangles.resize(triangleCount);
  polygons.inputFaceOf.resize(triangleCount);
  const auto cutBlock = [&](uint64_t block) {
    PolygonTriangulator triangulator;
    uint64_t triangle = firstTriangleOfBlock[block];
    const uint64_t end = std::min(polygonCount, (block + 1) * kPolygonsPerBlock);
    for (uint64_t i = block * kPolygonsPerBlock; i < end; ++i) {
      const uint64_t cornerCount = cornerCountOf(i);
      if (cornerCount < 3) continue;
      const std::span corners = std::span(polygons.corners).subspan(polygons.firstCorner[i], cornerCount);
      triangulator.triangulate(vertices, corners, std::span(triangles).subspan(triangle, cornerCount - 2));
      std::fill_n(polygons.inputFaceOf.begin() + static_cast<ptrdiff_t>(triangle), cornerCount - 2,
                  static_cast<uint32_t>(i));
      triangle += cornerCount - 2;
    }
  };
  if (firstTriangleOfBlock.size() == 1) return cutBlock(0);
  forEachTask(firstTriangleOfBlock.size(), cutBlock);
}

/// A corner is straight if turnAt(), the sine of its turn, is smaller than this number.
constexpr double kStraightSine = 1e-10;

void cutFan(std::span<const uint32_t> corners, std::span<Face> triangles) {
  for (size_t i = 0; i < triangles.size(); ++i) triangles[i] = {corners[0], corners[i + 1], corners[i + 2]};
}

}  // namespace

void InputFaces::reserve(uint64_t faceCount) {
  if (polygons_.isEmpty()) triangles_.reserve(triangles_.size() + faceCount);
}

void InputFaces::add(std::span<const uint32_t> corners) {
  if (polygons_.isEmpty()) {
    if (corners.size() == 3) {
      triangles_.push_back({corners[0], corners[1], corners[2]});
      return;
    }
    beginPolygons();
  }
  polygons_.corners.insert(polygons_.corners.end(), corners.begin(), corners.end());
  polygons_.firstCorner.push_back(polygons_.corners.size());
}

void InputFaces::addTriangles(std::vector<Face>&& triangles) {
  if (polygons_.isEmpty() && triangles_.empty()) {
    triangles_ = std::move(triangles);
  } else {
    for (const Face& face : triangles) add(face);
  }
}

void InputFaces::beginPolygons() {
  polygons_.firstCorner.reserve(triangles_.size() + 2);
  polygons_.corners.reserve(3 * triangles_.size());
  polygons_.firstCorner.push_back(0);
  for (const Face& face : triangles_) {
    polygons_.corners.insert(polygons_.corners.end(), face.begin(), face.end());
    polygons_.firstCorner.push_back(polygons_.corners.size());
  }
  freeMemory(triangles_);
}

void InputFaces::moveTo(std::span<const Vec3d> vertices, Mesh& mesh) {
  if (count() == 0)
    failInput(vertices.empty()
                  ? "has neither points nor faces"
                  : fmt::format("has {} and no face: a point cloud, not a mesh", counted(vertices.size(), "point")));
  if (!polygons_.isEmpty()) triangulateAll(vertices, polygons_, triangles_);
  if (triangles_.empty())
    failInput(count() == 1 ? "the only face has fewer than three corners"
                           : fmt::format("none of the {} faces has three corners", count()));
  requireAtMost(kMaxTriangleCount, triangles_.size(), "faces");
  mesh.faces = std::move(triangles_);
  mesh.polygons = std::move(polygons_);
}

void PolygonTriangulator::triangulate(std::span<const Vec3d> vertices, std::span<const uint32_t> corners,
                                      std::span<Face> triangles) {
  ASDFVK_CHECK_OP(corners.size(), ==, triangles.size() + 2);
  const size_t count = corners.size();
  if (count == 3 || count > kMaxEarClippedCorners || !project(vertices, corners)) return cutFan(corners, triangles);
  previous_.resize(count);
  next_.resize(count);
  for (size_t i = 0; i < count; ++i) {
    previous_[i] = static_cast<uint32_t>((i + count - 1) % count);
    next_[i] = static_cast<uint32_t>((i + 1) % count);
  }
  turn_.resize(count);
  reflex_.clear();
  for (uint32_t i = 0; i < count; ++i) {
    turn_[i] = turnAt(i);
    if (!(turn_[i] > kStraightSine)) reflex_.push_back(i);
  }
  if (reflex_.empty()) return cutFan(corners, triangles);
  clipEars(corners, triangles);
}

bool PolygonTriangulator::project(std::span<const Vec3d> vertices, std::span<const uint32_t> corners) {
  // Positions are relative to a corner and to the size of the polygon. Therefore the unit and the distance from the
  // origin have no effect.
  const Vec3d origin = vertices[corners[0]];
  double size = 0;
  for (const uint32_t corner : corners) {
    const Vec3d p = vertices[corner] - origin;
    for (size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(p[axis])) return false;
      size = std::max(size, std::abs(p[axis]));
    }
  }
  if (!(size > 0)) return false;
  const auto local = [&](size_t i) {
    const Vec3d p = vertices[corners[i]] - origin;
    return Vec3d{p.x / size, p.y / size, p.z / size};
  };
  Vec3d normal;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = local(i), b = local(i + 1 == corners.size() ? 0 : i + 1);
    normal = normal + Vec3d{(a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y)};
  }
  size_t axis = 0;
  for (size_t other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  if (!(std::abs(normal[axis]) > 0)) return false;
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  points_.resize(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3d p = local(i);
    points_[i] = normal[axis] > 0 ? Point2{p[u], p[v]} : Point2{p[v], p[u]};
  }
  return true;
}

/// Sine of the angle from the edge before `corner` to the edge after it. Positive for a turn to the left, 0 if an edge
/// has no length.
double PolygonTriangulator::turnAt(uint32_t corner) const {
  const Point2 a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
  const double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
  const double lengths =
      lengthInAnyUnit(Vec3d{b.x - a.x, b.y - a.y, 0}) * lengthInAnyUnit(Vec3d{c.x - b.x, c.y - b.y, 0});
  return lengths > 0 ? cross / lengths : 0;
}

bool PolygonTriangulator::isEar(uint32_t corner) const {
  if (!(turn_[corner] > kStraightSine)) return false;
  const uint32_t before = previous_[corner], after = next_[corner];
  const Point2 a = points_[before], b = points_[corner], c = points_[after];
  return std::none_of(reflex_.begin(), reflex_.end(), [&](uint32_t other) {
    if (isClipped_[other] || other == before || other == corner || other == after) return false;
    // The ends of a bridge to a hole occur twice in the polygon. A copy of a corner of the ear does not prevent the
    // ear.
    const Point2 p = points_[other];
    if (p == a || p == b || p == c) return false;
    return sideOf(a, b, p) >= 0 && sideOf(b, c, p) >= 0 && sideOf(c, a, p) >= 0;
  });
}

/// Returns the first ear from `start` on. A polygon without ears crosses itself or is flat; in this case, returns the
/// sharpest left turn.
uint32_t PolygonTriangulator::findEar(uint32_t start, size_t leftCount) const {
  uint32_t corner = start, sharpest = start;
  for (size_t i = 0; i < leftCount; ++i, corner = next_[corner]) {
    if (isEar_[corner]) return corner;
    if (turn_[corner] > turn_[sharpest]) sharpest = corner;
  }
  return sharpest;
}

void PolygonTriangulator::clipEars(std::span<const uint32_t> corners, std::span<Face> triangles) {
  isClipped_.assign(corners.size(), 0);
  isEar_.resize(corners.size());
  for (uint32_t i = 0; i < corners.size(); ++i) isEar_[i] = isEar(i);
  uint32_t start = 0;
  size_t leftCount = corners.size();
  for (Face& triangle : triangles) {
    const uint32_t ear = findEar(start, leftCount--);
    const uint32_t before = previous_[ear], after = next_[ear];
    triangle = {corners[before], corners[ear], corners[after]};
    next_[before] = after;
    previous_[after] = before;
    isClipped_[ear] = 1;
    for (const uint32_t neighbour : {before, after}) {
      turn_[neighbour] = turnAt(neighbour);
      isEar_[neighbour] = isEar(neighbour);
    }
    start = after;  // The search continues after the ear, so that the cuts do not all share one corner.
  }
}

}  // namespace asdfvk
