#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bvh/wide_bvh.h"
#include "cone/cone.h"
#include "core/vec3.h"
#include "trace/trace_scene.h"

namespace asdfvk::bench {

inline constexpr uint32_t kNoPrimitive = 0xffffffff;

/// A hierarchy as on a device.
struct DeviceScene {
  WideBvh bvh;
  std::vector<DeviceTriangle> triangles;  ///< In the order of bvh.primitiveFaces.
  float contactDistance;                  ///< See Cone.
};
[[nodiscard]] DeviceScene deviceSceneOf(const TraceScene& scene, const Cone& cone);

struct LaneRay {
  Vec3f origin, direction;  ///< In normalised coordinates.
  uint32_t excludedFace;
};

/// The twin of shaders/trace/trace_rays.comp for one lane: the caller decides when the lane makes a step.
class RayLane {
 public:
  void start(const LaneRay& ray);

  [[nodiscard]] bool hasNodes() const { return group_.bits != 0; }
  [[nodiscard]] bool hasTriangles() const { return queue_[0].bits != 0; }
  /// Whether triangles of as many nodes wait as the kernel can postpone.
  [[nodiscard]] bool isQueueFull() const { return queue_[2].bits != 0; }
  /// Visits the nearest node and adds its triangles to the queue. Preconditions: hasNodes(), not isQueueFull().
  void visitNode(const DeviceScene& scene);
  /// Tests up to `count` triangles of the queue. Precondition: hasTriangles().
  void testTriangles(const DeviceScene& scene, uint32_t count);

  [[nodiscard]] float hitDistance() const { return distance_; }
  [[nodiscard]] uint32_t hitPrimitive() const { return primitive_; }  ///< kNoPrimitive: no hit.
  [[nodiscard]] uint32_t nodeCount() const { return nodeCount_; }
  [[nodiscard]] uint32_t triangleCount() const { return triangleCount_; }
  [[nodiscard]] uint32_t greatestStackSize() const { return greatestStackSize_; }

 private:
  struct Group {
    uint32_t base, bits;
  };
  struct Leaves {
    uint32_t base = 0, bits = 0, all = 0;
  };

  [[nodiscard]] uint32_t permute(uint32_t bits) const;
  [[nodiscard]] uint32_t takeNearest();
  [[nodiscard]] uint32_t enterChildren(const DeviceWideNode& node) const;
  void test(const DeviceTriangle& triangle, uint32_t primitive, float contactDistance);

  LaneRay ray_;
  Vec3f inverse_, u_, w_;
  uint32_t octant_ = 0;  // Bit per axis: whether the component of the direction is negative.
  Group group_{};
  std::array<Group, kMaxBvhDepth> stack_;
  uint32_t stackSize_ = 0;
  std::array<Leaves, 3> queue_;
  float distance_ = 0;
  uint32_t primitive_ = kNoPrimitive;
  uint32_t nodeCount_ = 0, triangleCount_ = 0, greatestStackSize_ = 0;
};

}  // namespace asdfvk::bench
