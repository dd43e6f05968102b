#include "trace/embree_neighbours.h"

#include <array>
#include <cmath>

namespace asdfvk {
namespace {

struct Query {
  const TraceScene& scene;
  std::span<const SlotPlane> planes;
  Vec3d point;
  uint32_t slot;
  double radius;

  /// By the plane and the three lines of the edges, each moved outwards by the radius: beyond an acute corner this
  /// reaches farther.
  [[nodiscard]] bool isNear(uint32_t other) const {
    const SlotPlane& plane = planes[other];
    if (std::abs(dot(plane.normal, point) - plane.offset) > radius) return false;
    const Face& face = scene.mesh.faces[scene.bvh.slotFaces[other]];
    const auto corner = [&](size_t k) { return scene.bvh.normalization.toNormalized(scene.mesh.vertices[face[k]]); };
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d edge = corner((k + 1) % 3) - corner(k);
      if (dot(cross(plane.normal, edge), point - corner(k)) < -radius * length(edge)) return false;
    }
    return true;
  }
};

/// Of the node's box and the ball's.
bool overlap(const BvhNode& node, const Vec3f& low, const Vec3f& high) {
  return (node.min.x <= high.x) & (node.min.y <= high.y) & (node.min.z <= high.z) & (node.max.x >= low.x) &
         (node.max.y >= low.y) & (node.max.z >= low.z);
}

}  // namespace

bool hasNeighbourWithin(const TraceScene& scene, std::span<const SlotPlane> planes, const Vec3d& point, uint32_t slot,
                        double radius) {
  const Query query{scene, planes, point, slot, radius};
  // The boxes hold the triangles as doubles too.
  constexpr double kRounding = 0x1p-23;
  const double reach = radius + kRounding;
  const Vec3f low(point - Vec3d{reach, reach, reach}), high(point + Vec3d{reach, reach, reach});
  const std::vector<BvhNode>& nodes = scene.bvh.nodes;
  std::array<uint32_t, kMaxBvhDepth + 1> stack;
  size_t stackSize = 0;
  for (uint32_t index = 0;;) {
    const BvhNode& node = nodes[index];
    if (node.isLeaf()) {
      for (uint32_t other = node.first; other < node.first + node.triangleCount; ++other)
        if (other != slot && query.isNear(other)) return true;
    } else {
      const bool left = overlap(nodes[node.first], low, high), right = overlap(nodes[node.first + 1], low, high);
      if (left & right) stack[stackSize++] = node.first + 1;
      if (left | right) {
        index = node.first + (left ? 0 : 1);
        continue;
      }
    }
    if (stackSize == 0) return false;
    index = stack[--stackSize];
  }
}

}  // namespace asdfvk
