#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "asdf_vk/choices.h"
#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "bvh/bvh.h"
#include "shared/bvh_layout.h"
#include "vk/device_choice.h"

namespace asdfvk {

/// Assignment of rays to the lanes of a device.
enum class TraceKernel {
  Packet,  ///< shaders/trace_packet.comp: like Ray, but the lanes of a subgroup traverse the hierarchy together.
  Ray,     ///< shaders/trace_rays.comp: neighbouring lanes trace the rays of one seed.
  Seed,    ///< shaders/trace_rays.comp: neighbouring lanes trace the same ray of neighbouring seeds.
};

/// How kernels read the hierarchy.
enum class BvhFetch {
  Storage,  ///< Storage buffers.
  Texel,    ///< Storage texel buffers: much faster on llvmpipe. Many devices allow at most 65,536 texels (of 16 bytes).
};

/// All variants compute the same values.
struct VulkanTraceChoice {
  TraceKernel kernel = TraceKernel::Ray;
  BvhFetch fetch = BvhFetch::Texel;
  auto operator<=>(const VulkanTraceChoice&) const = default;
};

/// Unset members take the default of the device.
struct VulkanTraceRequest {
  std::optional<TraceKernel> kernel;
  std::optional<BvhFetch> fetch;

  [[nodiscard]] bool isEmpty() const { return !kernel && !fetch; }
};

/// The fastest variant for the class of the device (docs/speed.md).
[[nodiscard]] VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device);
[[nodiscard]] VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const VulkanTraceRequest& request);
/// The variant for one hierarchy. A request without a fetch gets the default fetch, or the other fetch if the hierarchy
/// may exceed only the limit of the default fetch.
[[nodiscard]] VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const VulkanTraceRequest& request,
                                               const Bvh& bvh);

inline constexpr ChoiceNames<TraceKernel, 3> kKernels{
    {{"seed", TraceKernel::Seed}, {"ray", TraceKernel::Ray}, {"packet", TraceKernel::Packet}}};
inline constexpr ChoiceNames<BvhFetch, 2> kFetches{{{"texel", BvhFetch::Texel}, {"storage", BvhFetch::Storage}}};

/// Parses names; an empty name and "auto" leave a member unset. Throws Error{UnknownName}.
[[nodiscard]] VulkanTraceRequest traceRequestOf(const TraceVariant& variant);
[[nodiscard]] TraceVariant variantOf(const VulkanTraceChoice& choice);

/// Workgroups of the kernels that trace rays, one ray per lane.
struct VulkanWorkgroupShape {
  uint32_t lanesPerCone = 32;  ///< Rays of a cone in neighbouring lanes.
  uint32_t conesPerWorkgroup = 1;
  /// Greatest number of loop iterations per ray; the reference traces cones with rays beyond the limit.
  uint32_t iterationLimit = 60'000;
};

[[nodiscard]] VulkanWorkgroupShape workgroupShapeFor(const DeviceFacts& device, uint32_t rayCount, TraceKernel kernel);

/// Traversal by single lanes (shaders/wide_walk.glsl). Results depend on the shape only if a ray hits equally near
/// triangles.
struct VulkanWalkShape {
  uint32_t stackSize = kMaxBvhDepth;  ///< Number of entries, at least kMaxBvhDepth.
  /// True: a lane postpones the triangles of up to three nodes and tests two at a time. False: the triangles of one
  /// node are tested one by one. The tests begin when each lane has triangles or no node left (Aila and Laine 2009).
  bool postponesTriangles = true;
};

/// CPU devices postpone triangles. GPUs test them at once, which saves registers. On AMD GPUs the stack of a lane is
/// larger than 256 bytes, because Mesa's compiler puts such arrays into memory, but smaller arrays into registers.
/// Packets share a stack.
[[nodiscard]] VulkanWalkShape walkShapeFor(const DeviceFacts& device);

}  // namespace asdfvk
