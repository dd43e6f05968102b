#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trace/trace_scene.h"
#include "trace/vk/vulkan_trace_choice.h"
#include "warps/ray_lane.h"

namespace asdfvk::bench {

/// How a kernel schedules rays on the lanes of a device.
struct WarpSchedule {
  VulkanWorkgroupShape shape;
  bool postponesTriangles;  ///< See VulkanWalkShape.
  uint32_t subgroupSize;    ///< At most the lanes of a workgroup.
};

/// The schedule that the program chooses for a device, with any kernel.
[[nodiscard]] WarpSchedule scheduleFor(const DeviceFacts& device, TraceKernel kernel, uint32_t rayCount);

struct WarpCounts {
  uint64_t rayCount = 0;
  /// Steps of subgroups: iterations of the loop over nodes, and of the loop over triangles.
  uint64_t nodeStepCount = 0, triangleStepCount = 0;
  uint64_t nodeCount = 0, triangleCount = 0;            ///< Visits of rays.
  std::array<uint64_t, kMaxBvhDepth + 1> stackSizes{};  ///< Rays by the greatest size of their stack.

  [[nodiscard]] double perRay(uint64_t count) const {
    return static_cast<double>(count) / static_cast<double>(rayCount);
  }
  [[nodiscard]] uint32_t greatestStackSize() const;
};

/// Instructions of one step of a subgroup.
struct StepCosts {
  double node, triangles;
};

/// Instructions of subgroups of 32 lanes per ray. An instruction of 64 lanes counts as two, because processors of 32
/// lanes execute it in two passes.
[[nodiscard]] double warpInstructionsPerRay(const WarpCounts& counts, const WarpSchedule& schedule,
                                            const StepCosts& costs);

/// Faces of cones in the order of the device: runs of kConesPerRun neighbours at regular distances.
[[nodiscard]] std::vector<uint32_t> sampleCones(const TraceScene& scene, std::span<const uint32_t> seedFaces,
                                                uint32_t runCount);
inline constexpr uint32_t kConesPerRun = 128;  ///< A multiple of the cones of a workgroup.

/// Receives each ray at its end: the cone as an index of `faces`, the ray of the cone, and the lane.
using RayEnd = std::function<void(uint32_t cone, uint32_t ray, const RayLane& lane)>;
/// Traces the cones of these faces as the subgroups of a device do.
[[nodiscard]] WarpCounts countWarps(const TraceScene& scene, const DeviceScene& device, const Cone& cone,
                                    std::span<const uint32_t> faces, const WarpSchedule& schedule,
                                    const RayEnd& atEnd = {});

}  // namespace asdfvk::bench
