#pragma once

#include "pipeline/backend.h"

namespace asdfvk {

class Device;

/// The device of the backend that makeVulkanBackend() made; null for any other backend.
[[nodiscard]] const Device* vulkanDeviceOf(const Backend& backend);

}  // namespace asdfvk
