#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "asdf_vk/report.h"
#include "bvh/device_bvh.h"
#include "vk/device_choice.h"

namespace asdfvk {

/// Assignment of rays to the lanes of a device.
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

/// Variant of the kernels; all variants compute the same values.
struct VulkanTraceChoice {
  TraceKernel kernel = TraceKernel::Ray;
  BvhLayout bvh = BvhLayout::Binary;
  BvhFetch fetch = BvhFetch::Texel;
  auto operator<=>(const VulkanTraceChoice&) const = default;
};

/// Requested variant; unset members take the default of the device.
struct VulkanTraceRequest {
  std::optional<TraceKernel> kernel;
  std::optional<BvhLayout> bvh;
  std::optional<BvhFetch> fetch;

  [[nodiscard]] bool isEmpty() const { return !kernel && !bvh && !fetch; }
};

/// The fastest variant for the class of the device (docs/speed.md).
[[nodiscard]] VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device);
/// The default with the requested members replaced.
[[nodiscard]] VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const VulkanTraceRequest& request);

/// Names of the variants, as in options and reports.
template <typename T>
using VariantNames = std::span<const std::pair<const char*, T>>;
[[nodiscard]] VariantNames<TraceKernel> kernelNames();
[[nodiscard]] VariantNames<BvhLayout> bvhNames();
[[nodiscard]] VariantNames<BvhFetch> fetchNames();

/// By names; an empty name and "auto" leave a member unset. Throws Error{UnknownName}.
[[nodiscard]] VulkanTraceRequest traceRequestOf(const TraceVariant& variant);
[[nodiscard]] TraceVariant variantOf(const VulkanTraceChoice& choice);

}  // namespace asdfvk
