#pragma once

#include <volk.h>

#include <optional>
#include <span>
#include <vector>

#include "vk/device_choice.h"

namespace asdfvk {

/// The first queue family with compute and without graphics; if there is none, the first family with compute. A family
/// without graphics does not delay the desktop, and on some systems has a longer watchdog timeout.
[[nodiscard]] std::optional<uint32_t> chooseComputeQueueFamily(std::span<const VkQueueFamilyProperties> families);

[[nodiscard]] DeviceFacts describeDevice(VkPhysicalDevice device);
[[nodiscard]] std::vector<DeviceFacts> describeDevices(std::span<const VkPhysicalDevice> devices);

[[nodiscard]] bool offersExtension(VkPhysicalDevice device, const char* name);

}  // namespace asdfvk
