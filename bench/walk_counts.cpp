#include "walk_counts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "trace/nearest_hit.h"

namespace asdfvk::bench {
namespace {

// For each visited node, the number of triangles tested after it.
using Steps = std::vector<uint32_t>;

/// The walk of one ray.
class Walk {
 public:
  Walk(const DeviceBvh& bvh, const Vec3d& origin, const Vec3d& direction, uint32_t excludedFace)
      : bvh_(bvh), frame_(origin, direction), origin_(origin), direction_(direction), excludedFace_(excludedFace) {}

  Steps steps() {
    if (bvh_.wideNodes.empty())
      enterBinary(0);
    else
      enterWide(0);
    return std::move(steps_);
  }

 private:
  // Distance to the box; infinity for a miss.
  [[nodiscard]] double enter(const double (&min)[3], const double (&max)[3]) const {
    double near = 0, far = distance_;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double t0 = (min[axis] - origin_[axis]) / direction_[axis],
                   t1 = (max[axis] - origin_[axis]) / direction_[axis];
      near = std::max(near, std::min(t0, t1));
      far = std::min(far, std::max(t0, t1));
    }
    return near <= far ? near : std::numeric_limits<double>::infinity();
  }

  void test(uint32_t primitive) {
    ++steps_.back();
    const DeviceTriangle& t = bvh_.triangles[primitive];
    if (t.faceIndex == excludedFace_) return;
    const auto point = [](const vec3& v) { return Vec3d{v.x, v.y, v.z}; };
    distance_ = std::min(distance_, hitTriangle(frame_, point(t.v0), point(t.v1), point(t.v2)).distance);
  }

  void enterBinary(uint32_t index) {
    steps_.push_back(0);
    const DeviceBvhNode& node = bvh_.nodes[index];
    const auto distanceTo = [&](const vec3& min, const vec3& max) {
      return enter({min.x, min.y, min.z}, {max.x, max.y, max.z});
    };
    struct Child {
      double distance;
      uint32_t reference;
    };
    std::array<Child, 2> children{
        {{distanceTo(node.leftMin, node.leftMax), node.left}, {distanceTo(node.rightMin, node.rightMax), node.right}}};
    if (children[1].distance < children[0].distance) std::swap(children[0], children[1]);
    for (const Child& child : children) {
      if (std::isinf(child.distance)) continue;
      const uint32_t count = child.reference >> kReferenceCountShift, first = child.reference & kReferenceFirstMask;
      if (count == 0) enterBinary(first);
      for (uint32_t primitive = first; primitive < first + count; ++primitive) test(primitive);
    }
  }

  void enterWide(uint32_t index) {
    steps_.push_back(0);
    const DeviceWideNode& node = bvh_.wideNodes[index];
    const float origin[3] = {node.origin.x, node.origin.y, node.origin.z};
    const uint32_t* const words[3] = {node.x.words, node.y.words, node.z.words};
    uint32_t entered = 0;
    for (uint32_t slot = 0; slot < kWideChildCount; ++slot) {
      double min[3], max[3];
      for (size_t axis = 0; axis < 3; ++axis) {
        const double scale = std::ldexp(1.0, static_cast<int>(node.exponents >> 8 * axis & 255) - 127);
        min[axis] = origin[axis] + scale * (words[axis][slot / 4] >> 8 * (slot % 4) & 255);
        max[axis] = origin[axis] + scale * (words[axis][2 + slot / 4] >> 8 * (slot % 4) & 255);
      }
      if (!std::isinf(enter(min, max))) entered |= 15u << 4 * slot;
    }
    const uint32_t leaves = node.childBits & ~kWideInnerBits, inner = node.childBits & kWideInnerBits;
    for (uint32_t bits = entered & leaves; bits != 0; bits &= bits - 1)
      test(node.triangleBase + static_cast<uint32_t>(std::popcount(leaves & ((bits & -bits) - 1))));
    const uint32_t octant = (direction_.x < 0) | (direction_.y < 0) << 1 | (direction_.z < 0) << 2;
    for (uint32_t i = 0; i < kWideChildCount; ++i) {
      const uint32_t bit = 8u << 4 * (i ^ octant);
      if ((entered & inner & bit) != 0)
        enterWide(node.childBase + static_cast<uint32_t>(std::popcount(inner & (bit - 1))));
    }
  }

  const DeviceBvh& bvh_;
  RayFrame frame_;
  Vec3d origin_, direction_;
  uint32_t excludedFace_;
  double distance_ = 1e30;
  Steps steps_;
};

}  // namespace

WalkCounts countWalks(const DeviceBvh& bvh, const TraceScene& scene, const Cone& cone,
                      std::span<const uint32_t> seeds) {
  WalkCounts counts;
  for (size_t begin = 0; begin + kNeighbourCount <= seeds.size(); begin += kNeighbourCount) {
    for (const Vec3d& local : cone.directions) {
      Steps together;
      for (const uint32_t face : seeds.subspan(begin, kNeighbourCount)) {
        const ConeFrame frame = paperConeFrame(cone, scene.geometry.normals[face], face);
        const Vec3d direction = frame.tangent * local.x + frame.bitangent * local.y + frame.axis * local.z;
        const Vec3d origin = scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]);
        const Steps steps = Walk(bvh, origin, direction, scene.representatives[face]).steps();
        together.resize(std::max(together.size(), steps.size()));
        for (size_t i = 0; i < steps.size(); ++i) {
          together[i] = std::max(together[i], steps[i]);
          counts.triangles += steps[i];
        }
        counts.nodes += static_cast<double>(steps.size());
      }
      counts.sharedNodes += static_cast<double>(together.size());
      for (const uint32_t count : together) counts.sharedTriangles += count;
    }
  }
  const double groupCount = static_cast<double>(seeds.size() / kNeighbourCount * cone.directions.size());
  if (groupCount == 0) return counts;
  return {counts.nodes / (groupCount * kNeighbourCount), counts.triangles / (groupCount * kNeighbourCount),
          counts.sharedNodes / groupCount, counts.sharedTriangles / groupCount};
}

}  // namespace asdfvk::bench
