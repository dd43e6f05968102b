#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "bvh/device_bvh.h"
#include "vk/device_choice.h"

namespace asdfvk {

/// How the rays of the cones share the lanes of a device out.
enum class TraceKernel {
  Packet,  ///< shaders/trace_packet.comp: as Ray, but the lanes of a subgroup share a stack and a node.
  Ray,     ///< shaders/trace_cone.comp: a workgroup per cone or few, each lane walks its own ray.
  Seed,    ///< shaders/trace_seed.comp: neighbouring lanes walk one ray of neighbouring seeds.
};

/// How kernels read the hierarchy.
enum class BvhFetch {
  Storage,  ///< Storage buffers.
  Texel,    ///< Storage texel buffers: far quicker on llvmpipe, and not bound to a storage buffer's range.
};

/// Which variant of the kernels traces; all of them give the same values.
struct VulkanTraceChoice {
  TraceKernel kernel = TraceKernel::Ray;
  BvhLayout bvh = BvhLayout::Binary;
  BvhFetch fetch = BvhFetch::Texel;
  auto operator<=>(const VulkanTraceChoice&) const = default;
};

/// What somebody asks for; the rest is as it is best.
struct VulkanTraceRequest {
  std::optional<TraceKernel> kernel;
  std::optional<BvhLayout> bvh;
  std::optional<BvhFetch> fetch;

  [[nodiscard]] bool isEmpty() const { return !kernel && !bvh && !fetch; }
};

/// The quickest for the class of the device, by the measurements in docs/speed.md.
[[nodiscard]] VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device);
/// The same but for what is asked for.
[[nodiscard]] VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const VulkanTraceRequest& request);

}  // namespace asdfvk
