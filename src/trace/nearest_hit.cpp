#include "trace/nearest_hit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bvh/leaf_faces.h"

namespace asdfvk {
namespace {

// Margin of the boxes for rounding. With the margin, a ray that hits a triangle also enters the box of the triangle.
// Coordinates relative to the origin are below 3.5, with relative errors of a few units of 2^-53. The margin is
// absolute, because the relative margin of Ize 2013 does not cover a ray along a side of the box.
constexpr double kBoxMargin = 1e-14;

// Test of a ray against boxes. The sign of the direction decides which side of a slab the ray reaches first. A
// component of 0 is replaced by a tiny number. The number is too small to move the ray, and large enough that the
// products of its inverse with box coordinates are finite.
struct SlabTest {
  Vec3d inverse, nearOrigin, farOrigin;
  std::array<bool, 3> isNegative{};

  SlabTest(const Vec3d& origin, const Vec3d& direction) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double d = direction[axis];
      inverse[axis] = 1 / (std::abs(d) < 1e-300 ? std::copysign(1e-300, d) : d);
      isNegative[axis] = std::signbit(d);
      const double margin = isNegative[axis] ? -kBoxMargin : kBoxMargin;
      nearOrigin[axis] = origin[axis] + margin;
      farOrigin[axis] = origin[axis] - margin;
    }
  }

  // Distance at which the ray enters the box; kNoHit if the ray misses the box or enters it beyond `limit`.
  [[nodiscard]] double entry(const BvhNode& node, double limit) const {
    double enter = 0, leave = limit;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double nearSide = isNegative[axis] ? node.max[axis] : node.min[axis];
      const double farSide = isNegative[axis] ? node.min[axis] : node.max[axis];
      enter = std::max(enter, (nearSide - nearOrigin[axis]) * inverse[axis]);
      leave = std::min(leave, (farSide - farOrigin[axis]) * inverse[axis]);
    }
    return enter <= leave ? enter : kNoHit;
  }
};

TriangleHit hitFace(const RayFrame& ray, const Bvh& bvh, const TriangleMesh& mesh, uint32_t face) {
  const auto [a, b, c] = bvh.normalization.normalizedCorners(mesh, face);
  return hitTriangle(ray, a, b, c);
}

struct StackEntry {
  uint32_t node = 0;
  double entry = 0;
};

/// counts(face): whether hits on a face count. contactDistance: Cone::contactDistance.
template <typename Counts>
class Walk {
 public:
  Walk(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction, double contactDistance,
       const Counts& counts)
      : bvh_(bvh),
        mesh_(mesh),
        ray_(origin, direction),
        slabs_(origin, direction),
        contactDistance_(contactDistance),
        counts_(counts) {}

  RayHit run() {
    if (bvh_.nodes.empty()) return best_;
    std::array<StackEntry, kMaxBvhDepth + 1> stack;
    size_t stackSize = 0;
    if (const double entry = slabs_.entry(bvh_.nodes[0], kNoHit); entry < kNoHit) stack[stackSize++] = {0, entry};
    while (stackSize > 0) {
      const StackEntry top = stack[--stackSize];
      if (top.entry > limit_) continue;
      const BvhNode& node = bvh_.nodes[top.node];
      if (node.isLeaf()) {
        testLeaf(node);
        continue;
      }
      StackEntry nearer{node.first, slabs_.entry(bvh_.nodes[node.first], limit_)};
      StackEntry farther{node.first + 1, slabs_.entry(bvh_.nodes[node.first + 1], limit_)};
      if (farther.entry < nearer.entry) std::swap(nearer, farther);
      if (farther.entry < kNoHit) stack[stackSize++] = farther;
      if (nearer.entry < kNoHit) stack[stackSize++] = nearer;
    }
    return best_;
  }

 private:
  void testLeaf(const BvhNode& leaf) {
    for (uint32_t primitive = leaf.first; primitive < leaf.first + leaf.triangleCount; ++primitive) {
      const uint32_t face = bvh_.primitiveFaces[primitive];
      if (!counts_(face)) continue;
      const TriangleHit hit = hitFace(ray_, bvh_, mesh_, face);
      if (hit.distance == kNoHit || hit.distance < contactDistance_) continue;
      const double limit = hit.isOuterSide ? hit.distance + double{kOuterSideFactor} * contactDistance_ : hit.distance;
      if (limit > limit_ || (limit == limit_ && face > best_.face)) continue;
      limit_ = limit;
      best_ = {hit.distance, face};
    }
  }
  const Bvh& bvh_;
  const TriangleMesh& mesh_;
  RayFrame ray_;
  SlabTest slabs_;
  double contactDistance_;
  const Counts& counts_;
  RayHit best_;
  // best_.distance, plus kOuterSideFactor * contactDistance_ if best_ is on the outer side of its face.
  double limit_ = kNoHit;
};

}  // namespace

bool isHitBetween(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction, double begin,
                  double end) {
  const RayFrame ray(origin, direction);
  const SlabTest slabs(origin, direction);
  bool isHit = false;
  forEachLeafFace(
      bvh, [&](const BvhNode& node) { return slabs.entry(node, end) != kNoHit; },
      [&](uint32_t face) {
        const double distance = hitFace(ray, bvh, mesh, face).distance;
        isHit = begin <= distance && distance <= end;
        return !isHit;
      });
  return isHit;
}

RayHit nearestHit(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction,
                  uint32_t skippedFace, double contactDistance) {
  const auto counts = [&](uint32_t face) { return face != skippedFace; };
  return Walk(bvh, mesh, origin, direction, contactDistance, counts).run();
}

RayHit nearestHitAmong(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction,
                       FunctionRef<bool(uint32_t face)> counts) {
  return Walk(bvh, mesh, origin, direction, 0, counts).run();
}

}  // namespace asdfvk
