#include "vk/open_device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"

namespace asdfvk {

OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request) {
  const std::vector<VkPhysicalDevice> physical = instance.physicalDevices();
  if (physical.empty())
    throw Error(ErrorKind::Device,
                "no Vulkan device was found; install a driver (mesa-vulkan-drivers has one for any CPU)");
  std::vector<DeviceFacts> facts;
  for (const VkPhysicalDevice device : physical) facts.push_back(describeDevice(device));
  const DeviceChoice choice = chooseDevice(facts, request);
  if (!choice.index)
    throw Error(ErrorKind::Device,
                fmt::format("no usable Vulkan device: {}; see --list-devices", fmt::join(choice.reasons, ", ")));
  const DeviceFacts& chosen = facts[*choice.index];
  return {std::make_unique<Device>(physical[*choice.index], chosen),
          fmt::format("{}, driver {}", choice.reasons[*choice.index], chosen.driver)};
}

}  // namespace asdfvk
