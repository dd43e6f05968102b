#include "trace/embree/near_faces.h"

#include <bit>
#include <cmath>

#include "core/check.h"

namespace asdfvk {
namespace {

constexpr size_t kPointCount = kLaneCount<Float8>;

/// One walk of the hierarchy for all points: neighbours meet mostly the same nodes.
class NeighbourWalk {
 public:
  ASDFVK_ALWAYS_INLINE NeighbourWalk(const TraceScene& scene, std::span<const SlotPlane> planes,
                                     std::span<const SlotPoint> points, double radius)
      : scene_(scene), planes_(planes), points_(points), radius_(radius) {
    ASDFVK_CHECK_OP(points.size(), <=, kPointCount);
    // float32 moves the points; the boxes hold the triangles as doubles too.
    const double reach = radius + 0x1p-23;
    for (size_t axis = 0; axis < 3; ++axis)
      for (size_t lane = 0; lane < kPointCount; ++lane) {
        const double centre = lane < points.size() ? points[lane].point[axis] : 4;  // Outside of every box.
        low_[axis][lane] = static_cast<float>(centre - reach);
        high_[axis][lane] = static_cast<float>(centre + reach);
      }
  }

  ASDFVK_ALWAYS_INLINE std::array<bool, kPointCount> run() {
    const std::span<const BvhNode> nodes = scene_.bvh.nodes;
    std::array<uint32_t, kMaxBvhDepth + 1> stack;
    size_t stackSize = 0;
    if (!nodes.empty()) stack[stackSize++] = 0;
    while (stackSize > 0) {
      const BvhNode& node = nodes[stack[--stackSize]];
      if (node.isLeaf()) {
        testLeaf(node);
        continue;
      }
      for (const uint32_t child : {node.first, node.first + 1})
        if (overlapsAny(nodes[child])) {
          stack[stackSize++] = child;
          if (!nodes[child].isLeaf()) {
            __builtin_prefetch(&nodes[nodes[child].first]);
            __builtin_prefetch(&nodes[nodes[child].first + 1]);
          } else {
            __builtin_prefetch(&planes_[nodes[child].first]);
          }
        }
    }
    return isFound_;
  }

 private:
  /// The mask of the points whose boxes overlap that of the node.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE IntsOf<Float8> overlaps(const BvhNode& node) const {
    return (low_[0] <= node.max.x) & (low_[1] <= node.max.y) & (low_[2] <= node.max.z) & (high_[0] >= node.min.x) &
           (high_[1] >= node.min.y) & (high_[2] >= node.min.z);
  }

  [[nodiscard]] ASDFVK_ALWAYS_INLINE bool overlapsAny(const BvhNode& node) const {
    const auto words = std::bit_cast<std::array<uint64_t, 4>>(overlaps(node));
    return (words[0] | words[1] | words[2] | words[3]) != 0;
  }

  ASDFVK_ALWAYS_INLINE void testLeaf(const BvhNode& leaf) {
    const IntsOf<Float8> isIn = overlaps(leaf);
    for (size_t lane = 0; lane < points_.size(); ++lane) {
      if (isIn[lane] == 0 || isFound_[lane]) continue;
      for (uint32_t slot = leaf.first; slot < leaf.first + leaf.triangleCount; ++slot)
        if (slot != points_[lane].slot && isNear(points_[lane].point, slot)) isFound_[lane] = true;
    }
  }

  /// By the plane and the three lines of the edges, each moved outwards by the radius: beyond an acute corner this
  /// reaches farther.
  [[nodiscard]] bool isNear(const Vec3d& point, uint32_t slot) const {
    const SlotPlane& plane = planes_[slot];
    if (std::abs(dot(plane.normal, point) - plane.offset) > radius_) return false;
    const Face& face = scene_.mesh.faces[scene_.bvh.slotFaces[slot]];
    const auto corner = [&](size_t k) { return scene_.bvh.normalization.toNormalized(scene_.mesh.vertices[face[k]]); };
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d edge = corner((k + 1) % 3) - corner(k);
      if (dot(cross(plane.normal, edge), point - corner(k)) < -radius_ * length(edge)) return false;
    }
    return true;
  }

  const TraceScene& scene_;
  std::span<const SlotPlane> planes_;
  std::span<const SlotPoint> points_;
  double radius_;
  std::array<Float8, 3> low_{}, high_{};  // The boxes around the points.
  std::array<bool, kPointCount> isFound_{};
};

}  // namespace

std::array<bool, 8> haveNeighboursWithin(const TraceScene& scene, std::span<const SlotPlane> planes,
                                         std::span<const SlotPoint> points, double radius,
                                         InstructionSet instructionSet) {
  return dispatch<Float8>(instructionSet, [&]<typename>() ASDFVK_ALWAYS_INLINE {
    return NeighbourWalk(scene, planes, points, radius).run();
  });
}

}  // namespace asdfvk
