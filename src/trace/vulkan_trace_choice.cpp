#include "trace/vulkan_trace_choice.h"

namespace asdfvk {

VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device, uint32_t /*rayCount*/) {
  if (device.kind == DeviceKind::Cpu) return {TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};
  return {};
}

}  // namespace asdfvk
