#include "trace/vulkan/vulkan_trace_choice.h"

namespace asdfvk {
namespace {

// What is best by class of device; neither the share of the seeds nor the number of rays changed an order.
constexpr VulkanTraceChoice kCpuDevice{TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};      // measured
constexpr VulkanTraceChoice kSmallSubgroup{TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};  // as on CPU devices
// Not measured as yet: what the first release has run on.
constexpr VulkanTraceChoice kSubgroupOf32{TraceKernel::Ray, BvhLayout::Binary, BvhFetch::Texel};
constexpr VulkanTraceChoice kSubgroupOf64{TraceKernel::Ray, BvhLayout::Binary, BvhFetch::Texel};

constexpr uint32_t kLargestSmallSubgroup = 16;

}  // namespace

VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device) {
  if (device.kind == DeviceKind::Cpu) return kCpuDevice;
  if (device.subgroupSize <= kLargestSmallSubgroup) return kSmallSubgroup;
  return device.subgroupSize <= 32 ? kSubgroupOf32 : kSubgroupOf64;
}

VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const VulkanTraceRequest& request) {
  const VulkanTraceChoice best = defaultTraceChoice(device);
  return {request.kernel.value_or(best.kernel), request.bvh.value_or(best.bvh), request.fetch.value_or(best.fetch)};
}

}  // namespace asdfvk
