#pragma once

#include <compare>
#include <cstdint>

#include "asdf_vk/report.h"
#include "bvh/bvh.h"
#include "shared/bvh_layout.h"
#include "shared/node_arithmetic.h"
#include "vk/device_choice.h"

namespace asdfvk {

struct VulkanTraceChoice {
  TraceKernel kernel = TraceKernel::Seed;
  BvhFetch fetch = BvhFetch::Texel;
  auto operator<=>(const VulkanTraceChoice&) const = default;
  [[nodiscard]] TraceVariant variant() const { return {kernel, fetch}; }
};

/// The variant for the class of the device. The kernel `seed` is the fastest on lavapipe (docs/speed.md) and needs the
/// fewest instructions on GPUs (docs/devices.md).
[[nodiscard]] VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device);
/// request: unset members take the default of the device.
[[nodiscard]] VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const TraceVariant& request);
/// The variant for one hierarchy. A request without a fetch gets the default fetch, or the other fetch if the hierarchy
/// may exceed only the limit of the default fetch.
[[nodiscard]] VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const TraceVariant& request, const Bvh& bvh);

/// Workgroups of the kernels that trace rays, one ray per lane.
struct VulkanWorkgroupShape {
  uint32_t lanesPerCone = 32;  ///< Rays of a cone in neighbouring lanes.
  uint32_t conesPerWorkgroup = 1;
  /// Greatest number of loop iterations per ray; the reference traces cones with rays beyond the limit.
  uint32_t iterationLimit = 60'000;
};

[[nodiscard]] VulkanWorkgroupShape workgroupShapeFor(const DeviceFacts& device, uint32_t rayCount, TraceKernel kernel);

/// The values of shared/node_arithmetic.h.
enum class NodeArithmetic : uint32_t {
  MaskedBytes = kMaskedBytes,
  ShiftedBytes = kShiftedBytes,
  MantissaBytes = kMantissaBytes,
};

/// Traversal by single lanes (shaders/trace/trace_rays.comp). Results depend on the shape only if a ray hits equally
/// near triangles.
struct VulkanWalkShape {
  /// Number of entries. A hierarchy of more levels is traced with kMaxBvhDepth entries instead.
  uint32_t stackSize = kMaxBvhDepth;
  /// True: a lane postpones the triangles of up to three nodes and tests two at a time. False: the triangles of one
  /// node are tested one by one. The tests begin when each lane has triangles or no node left (Aila and Laine 2009).
  bool postponesTriangles = true;
  NodeArithmetic arithmetic = NodeArithmetic::MaskedBytes;  ///< Also of packets.
  uint32_t subgroupSize = 0;  ///< ComputePipelineDescription::requiredSubgroupSize, also of packets.
};

/// GPUs have a short stack, because its memory is reserved for every lane that can run. On AMD GPUs the stack of a lane
/// is larger than 256 bytes, because Mesa's compiler puts such arrays into memory, but smaller arrays into registers.
/// Packets share a stack of kMaxBvhDepth entries. AMD GPUs that have subgroups of 32 and 64 lanes run 32: their drivers
/// would choose 64, of which fewer are busy (docs/devices.md).
[[nodiscard]] VulkanWalkShape walkShapeFor(const DeviceFacts& device);

}  // namespace asdfvk
