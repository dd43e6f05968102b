#include "trace/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "bvh/leaf_faces.h"
#include "core/random.h"
#include "core/vec3.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

constexpr size_t kAgreeingCount = 2, kMaxDirectionCount = 24;
// A ray that passes an edge at a smaller distance may count both of its faces, or none.
constexpr double kEdgeDistance = 1e-9;

Vec3d randomDirection(Random& random) {
  for (;;) {
    const Vec3d v{2 * random.real() - 1, 2 * random.real() - 1, 2 * random.real() - 1};
    const double squared = dot(v, v);
    if (squared > 0.01 && squared <= 1) return v / std::sqrt(squared);
  }
}

bool reachesBox(const BvhNode& node, const Vec3d& origin, const Vec3d& inverse) {
  double enter = 0, leave = kNoHit;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double a = (double{node.min[axis]} - origin[axis]) * inverse[axis];
    const double b = (double{node.max[axis]} - origin[axis]) * inverse[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * (1 + 1e-12) + 1e-12;
}

enum class Passage { Beside, Outwards, Inwards, Unclear };

/// How the ray passes a triangle. Outwards: it leaves through the outer side.
Passage passageOf(const RayFrame& ray, const std::array<Vec3d, 3>& corners) {
  std::array<Vec3d, 3> p;
  for (size_t k = 0; k < 3; ++k) p[k] = ray.toRay(corners[k]);
  std::array<double, 3> sides, lengths;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d &from = p[k], &to = p[(k + 1) % 3];
    sides[k] = from.x * to.y - from.y * to.x;
    lengths[k] = lengthInAnyUnit(Vec3d{to.x - from.x, to.y - from.y, 0});
  }
  double least = kNoHit, greatest = -kNoHit;  // Distances from the edges.
  for (size_t k = 0; k < 3; ++k) {
    const double distance = lengths[k] > 0 ? sides[k] / lengths[k] : 0;
    least = std::min(least, distance);
    greatest = std::max(greatest, distance);
  }
  if (least < -kEdgeDistance && greatest > kEdgeDistance) return Passage::Beside;
  const double det = sides[0] + sides[1] + sides[2];
  const bool isClear = least > kEdgeDistance || greatest < -kEdgeDistance;
  if (!isClear) {
    // Near the line of an edge, but perhaps far from the triangle.
    for (size_t axis = 0; axis < 2; ++axis) {
      const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
      if (low > kEdgeDistance || high < -kEdgeDistance) return Passage::Beside;
    }
    return std::max({p[0].z, p[1].z, p[2].z}) < 0 ? Passage::Beside : Passage::Unclear;
  }
  const double t = (sides[1] * p[0].z + sides[2] * p[1].z + sides[0] * p[2].z) / det;
  if (std::abs(t) <= kEdgeDistance) return Passage::Unclear;
  if (t < 0) return Passage::Beside;
  return det > 0 ? Passage::Outwards : Passage::Inwards;
}

std::optional<int> crossingsAlong(const TraceScene& scene, std::span<const uint32_t> weights, const Vec3d& origin,
                                  const Vec3d& direction) {
  const RayFrame ray(origin, direction);
  const Vec3d inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
  int crossings = 0;
  bool isClear = true;
  forEachLeafFace(
      scene.bvh, [&](const BvhNode& node) { return reachesBox(node, origin, inverse); },
      [&](uint32_t face) {
        if (weights[face] == 0) return true;
        const Passage passage = passageOf(ray, scene.bvh.normalization.normalizedCorners(scene.mesh, face));
        if (passage == Passage::Outwards) crossings += static_cast<int>(weights[face]);
        if (passage == Passage::Inwards) crossings -= static_cast<int>(weights[face]);
        isClear = passage != Passage::Unclear;
        return isClear;
      });
  return isClear ? std::optional(crossings) : std::nullopt;
}

}  // namespace

int windingNumberAt(const TraceScene& scene, std::span<const uint32_t> weights, const Vec3d& point) {
  Random random(1);
  std::map<int, size_t> votes;
  for (size_t i = 0; i < kMaxDirectionCount; ++i) {
    const std::optional<int> crossings = crossingsAlong(scene, weights, point, randomDirection(random));
    if (!crossings) continue;
    // After a disagreement, one more ray has to agree.
    if (++votes[*crossings] >= kAgreeingCount + (votes.size() > 1 ? 1 : 0)) return *crossings;
  }
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? 0 : most->first;
}

}  // namespace asdfvk
