// Costs of hierarchies, counted and not timed: a change that makes tracing slower fails here. If a change makes them
// cheaper on purpose, store the new numbers.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bvh/bvh_invariants.h"
#include "bvh/lane_bvh.h"
#include "bvh/wide_bvh.h"
#include "generate/generated_shape.h"
#include "support/bvh_statistics.h"

namespace asdfvk {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// What a ray with the nearest hit visits if the nearer child is visited first.
struct Visits {
  uint64_t nodes = 0, triangles = 0;
};

/// Distance at which a ray enters a box, infinite if it misses the box.
double entryOf(const BvhNode& node, const Vec3d& origin, const Vec3d& direction) {
  double from = 0, to = kInfinite;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double a = (node.min[axis] - origin[axis]) / direction[axis],
                 b = (node.max[axis] - origin[axis]) / direction[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to ? from : kInfinite;
}

/// Distance to a triangle (Moeller and Trumbore 1997), infinite if the ray misses it or begins on it.
double hitOf(const std::array<Vec3d, 3>& corners, const Vec3d& origin, const Vec3d& direction) {
  const Vec3d u = corners[1] - corners[0], v = corners[2] - corners[0], p = cross(direction, v);
  const double determinant = dot(u, p);
  if (determinant == 0) return kInfinite;
  const Vec3d from = origin - corners[0], q = cross(from, u);
  const double a = dot(from, p) / determinant, b = dot(direction, q) / determinant, t = dot(v, q) / determinant;
  return a >= 0 && b >= 0 && a + b <= 1 && t > 1e-6 ? t : kInfinite;
}

void countVisits(const Bvh& bvh, const Mesh& mesh, const Vec3d& origin, const Vec3d& direction, Visits& visits) {
  double nearest = kInfinite;
  std::vector<std::pair<double, uint32_t>> stack{{entryOf(bvh.nodes[0], origin, direction), 0}};
  while (!stack.empty()) {
    const auto [entry, index] = stack.back();
    stack.pop_back();
    if (entry >= nearest) continue;
    ++visits.nodes;
    const BvhNode& node = bvh.nodes[index];
    for (uint32_t i = 0; i < node.triangleCount; ++i) {
      ++visits.triangles;
      const auto corners = bvh.normalization.normalizedCorners(mesh, bvh.primitiveFaces[node.first + i]);
      nearest = std::min(nearest, hitOf(corners, origin, direction));
    }
    if (node.isLeaf()) continue;
    std::pair<double, uint32_t> near{entryOf(bvh.nodes[node.first], origin, direction), node.first},
        far{entryOf(bvh.nodes[node.first + 1], origin, direction), node.first + 1};
    if (far.first < near.first) std::swap(near, far);
    if (far.first < nearest) stack.push_back(far);
    if (near.first < nearest) stack.push_back(near);
  }
}

struct Quality {
  double sahCost = 0, nodesPerRay = 0, trianglesPerRay = 0;  // The binary hierarchy.
  double bytes = 0, wideBytes = 0, laneBytes = 0;            // Per face: the binary hierarchy and two layouts.
};

Quality qualityOf(const Mesh& mesh) {
  const Bvh bvh = buildOver(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  Visits visits;
  uint64_t rayCount = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); face += 7, ++rayCount) {
    const Vec3d& normal = geometry.normals[face];
    const Vec3d inwards = -1.0 * normal + 0.3 * Vec3d{normal.y, -normal.z, normal.x};
    countVisits(bvh, mesh, bvh.normalization.toNormalized(geometry.barycentres[face]), inwards, visits);
  }
  const Bvh forLanes = buildOver(mesh, {.maxLeafTriangleCount = kMaxLeafTriangleCount});
  const WideBvh wide = encodeWideBvh(bvh);
  const LaneBvh lanes = encodeLaneBvh(forLanes, mesh);
  const auto perFace = [&](size_t byteCount) {
    return static_cast<double>(byteCount) / static_cast<double>(mesh.faceCount());
  };
  const auto perRay = [&](uint64_t count) { return static_cast<double>(count) / static_cast<double>(rayCount); };
  return {computeBvhStatistics(bvh).sahCost,
          perRay(visits.nodes),
          perRay(visits.triangles),
          perFace(bvh.nodes.size() * sizeof(BvhNode) + 4 * bvh.primitiveFaces.size()),
          perFace(wide.nodes.size() * sizeof(DeviceWideNode) + 4 * wide.primitiveFaces.size()),
          perFace(lanes.nodes.size() * sizeof(LaneNode) + lanes.blocks.size() * sizeof(LaneBlock))};
}

}  // namespace

TEST_CASE("the costs of hierarchies are within 1 % of the stored ones") {
  const struct {
    const char* shape;
    Quality quality;
  } rows[]{{"animal", {18.5054, 31.4918, 4.9288, 37.6148, 12.0858, 62.2169}},
           {"hand", {21.5261, 29.605, 4.83462, 37.6838, 11.821, 60.4205}},
           {"tree", {12.1515, 30.7281, 5.26773, 38.0556, 11.961, 62.1844}}};
  for (const auto& row : rows) {
    CAPTURE(std::string(row.shape));
    const Quality &stored = row.quality, now = qualityOf(generateShape(row.shape, 20'000).mesh);
    INFO("{", now.sahCost, ", ", now.nodesPerRay, ", ", now.trianglesPerRay, ", ", now.bytes, ", ", now.wideBytes, ", ",
         now.laneBytes, "}");
    CHECK(now.sahCost == doctest::Approx(stored.sahCost).epsilon(0.01));
    CHECK(now.nodesPerRay == doctest::Approx(stored.nodesPerRay).epsilon(0.01));
    CHECK(now.trianglesPerRay == doctest::Approx(stored.trianglesPerRay).epsilon(0.01));
    CHECK(now.bytes == doctest::Approx(stored.bytes).epsilon(0.01));
    CHECK(now.wideBytes == doctest::Approx(stored.wideBytes).epsilon(0.01));
    CHECK(now.laneBytes == doctest::Approx(stored.laneBytes).epsilon(0.01));
  }
}

}  // namespace asdfvk
