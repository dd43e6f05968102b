#include "trace/nearest_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/box3.h"

namespace asdfvk {
namespace {

/// Because of rounding, distances that differ by at most this number count as equal.
constexpr double kEqualDistance = 1e-12;
/// Relative and absolute margin of a given bound.
constexpr double kBoundMargin = 1e-9;

void offer(const TraceScene& scene, uint32_t face, const Vec3d& p, SurfacePoint& best) {
  const PlaneTriangle triangle = triangleOf(scene, face);
  const Vec3d& normal = triangle.normal;
  if (std::abs(dot(p - triangle.corners[0], normal)) > best.distance + kEqualDistance) return;
  const Vec3d point = nearestPoint(triangle, p), way = p - point;
  const double distance = length(way);
  if (distance > best.distance + kEqualDistance) return;
  const double side = distance > 0 ? dot(way, normal) / distance : 0;
  if (distance >= best.distance - kEqualDistance && std::abs(side) <= std::abs(best.side)) return;
  best = {std::min(distance, best.distance), point, face, side};
}

}  // namespace

Vec3d nearestOnSegment(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  const Vec3d edge = b - a;
  return a + std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0) * edge;
}

Vec3d nearestPoint(const PlaneTriangle& triangle, const Vec3d& p) {
  const auto& [a, b, c] = triangle.corners;
  const Vec3d& normal = triangle.normal;
  const auto isInside = [&](const Vec3d& from, const Vec3d& to) {
    return dot(cross(to - from, p - from), normal) >= 0;
  };
  if (isInside(a, b) && isInside(b, c) && isInside(c, a)) return p - dot(p - a, normal) * normal;
  Vec3d best = nearestOnSegment(a, b, p);
  for (const Vec3d& candidate : {nearestOnSegment(b, c, p), nearestOnSegment(c, a, p)})
    if (length(p - candidate) < length(p - best)) best = candidate;
  return best;
}

SurfacePoint nearestSurfacePoint(const TraceScene& scene, const Vec3d& p, double enough,
                                 FunctionRef<uint32_t(uint32_t)> faceOf, double atMost) {
  struct Entry {
    uint32_t node;
    double squaredDistance;
  };
  // The distance of the first face may exceed atMost by rounding.
  SurfacePoint best{.distance = atMost * (1 + kBoundMargin) + kBoundMargin};
  const std::span<const BvhNode> nodes = scene.bvh.nodes;
  std::array<Entry, kMaxBvhDepth + 1> stack;
  size_t stackSize = 0;
  if (!nodes.empty()) stack[stackSize++] = {0, 0};
  while (stackSize > 0 && (best.face == kNoFace || !(best.distance < enough))) {
    const auto [index, squaredDistance] = stack[--stackSize];
    const BvhNode& node = nodes[index];
    const double reach = best.distance + kEqualDistance;
    if (squaredDistance > reach * reach) continue;
    if (node.isLeaf()) {
      for (uint32_t i = node.first; i < node.first + node.triangleCount; ++i)
        if (const uint32_t face = faceOf(scene.bvh.primitiveFaces[i]); face != kNoFace) offer(scene, face, p, best);
      continue;
    }
    const Entry left{node.first, squaredDistanceToBox(nodes[node.first], p)};
    const Entry right{node.first + 1, squaredDistanceToBox(nodes[node.first + 1], p)};
    const bool leftFirst = left.squaredDistance < right.squaredDistance;
    stack[stackSize++] = leftFirst ? right : left;
    stack[stackSize++] = leftFirst ? left : right;
  }
  return best.face == kNoFace ? SurfacePoint{} : best;
}

}  // namespace asdfvk
