#pragma once

#include <cstdint>

#include "trace/vulkan/vulkan_trace_choice.h"
#include "vk/device_choice.h"

namespace asdfvk {

/// How the cone kernel fills a device.
struct VulkanWorkgroupShape {
  /// Ray: each walks rayCount / lanesPerCone rays, rounded up. Seed: so many rays of a cone are side by side.
  uint32_t lanesPerCone = 32;
  uint32_t conesPerWorkgroup = 1;
  uint32_t iterationLimit = 60'000;  ///< Of one lane; beyond it the cone is redone by the reference.
};

[[nodiscard]] VulkanWorkgroupShape workgroupShapeFor(const DeviceFacts& device, uint32_t rayCount,
                                                     TraceKernel kernel = TraceKernel::Ray);

}  // namespace asdfvk
