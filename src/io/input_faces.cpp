#include "io/input_faces.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/input_failure.h"
#include "io/triangulate.h"

namespace asdfvk {
namespace {

constexpr uint64_t kMaxIndexCount = std::numeric_limits<uint32_t>::max();
constexpr uint64_t kPolygonsPerBlock = 4096;

[[noreturn]] void failSize(const std::string& counts) {
  throw Error(ErrorCode::MeshTooLarge, fmt::format("has {}; at most {} are supported", counts, kMaxIndexCount));
}

void triangulateAll(std::span<const Vec3d> vertices, Polygons& polygons, std::vector<Face>& triangles) {
  const uint64_t polygonCount = polygons.firstCorner.size() - 1;
  const auto cornerCountOf = [&](uint64_t i) { return polygons.firstCorner[i + 1] - polygons.firstCorner[i]; };
  std::vector<uint64_t> firstTriangleOfBlock;
  uint64_t triangleCount = 0;
  for (uint64_t i = 0; i < polygonCount; ++i) {
    if (i % kPolygonsPerBlock == 0) firstTriangleOfBlock.push_back(triangleCount);
    triangleCount += std::max<uint64_t>(cornerCountOf(i), 2) - 2;
  }
  if (triangleCount > kMaxIndexCount || polygonCount > kMaxIndexCount)
    failSize(fmt::format("{} and {} triangles", counted(polygonCount, "face"), triangleCount));
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
  tbb::parallel_for(uint64_t{0}, uint64_t{firstTriangleOfBlock.size()}, cutBlock);
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
  triangles_ = {};
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
  if (triangles_.size() > kMaxIndexCount) failSize(fmt::format("{} faces", triangles_.size()));
  mesh.faces = std::move(triangles_);
  mesh.polygons = std::move(polygons_);
}

void requireIndexableVertexCount(uint64_t count) {
  if (count > kMaxIndexCount) failSize(fmt::format("{} vertices", count));
}

}  // namespace asdfvk
