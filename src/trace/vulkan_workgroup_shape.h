#pragma once

#include <cstdint>

#include "vk/device_choice.h"

namespace asdfvk {

/// How the cone kernel fills a device.
struct VulkanWorkgroupShape {
  uint32_t lanesPerCone = 32;  ///< Each walks rayCount / lanesPerCone rays, rounded up.
  uint32_t conesPerWorkgroup = 1;
  uint32_t iterationLimit = 60'000;  ///< Of one lane; beyond it the cone is redone by the reference.
};

[[nodiscard]] VulkanWorkgroupShape workgroupShapeFor(const DeviceFacts& device, uint32_t rayCount);

}  // namespace asdfvk
