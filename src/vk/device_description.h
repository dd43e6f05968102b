#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "vk/device_choice.h"

namespace asdfvk {

class Instance;

/// Properties of a device for reports: names as in Vulkan, plain data.
struct DeviceDescription {
  struct Heap {
    uint64_t byteCount = 0;
    bool isDeviceLocal = false;
  };
  struct MemoryType {
    uint32_t heap = 0;
    std::vector<std::string> flags;  ///< "deviceLocal", "hostVisible", ...
  };
  struct QueueFamily {
    uint32_t queueCount = 0;
    std::vector<std::string> flags;  ///< "graphics", "compute", "transfer"
    uint32_t timestampValidBits = 0;
  };

  DeviceFacts facts;
  uint32_t vendorId = 0, deviceId = 0, driverId = 0, driverVersion = 0;
  std::vector<std::pair<std::string, uint64_t>> limits;
  std::vector<std::string> subgroupOperations;  ///< In compute shaders.
  std::vector<std::string> features;            ///< Those that the device has, of a selection.
  std::vector<std::string> extensions;          ///< Likewise.
  std::vector<Heap> heaps;
  std::vector<MemoryType> memoryTypes;
  std::vector<QueueFamily> queueFamilies;
};

/// index: in Instance::physicalDevices(). Precondition: the device supports Vulkan 1.2.
[[nodiscard]] DeviceDescription describeInFull(const Instance& instance, uint32_t index);

}  // namespace asdfvk
