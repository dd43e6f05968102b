#include "vk/open_device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {

OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request) {
  const std::vector<VkPhysicalDevice> physical = instance.physicalDevices();
  if (physical.empty()) throw Error(ErrorCode::NoVulkanDriver, "no Vulkan device was found");
  std::vector<DeviceFacts> facts;
  for (const VkPhysicalDevice device : physical) facts.push_back(describeDevice(device));
  const DeviceChoice choice = chooseDevice(facts, request);
  std::vector<std::string> reasons;
  for (size_t i = 0; i < facts.size(); ++i)
    reasons.push_back(fmt::format("{} ({}): {}", facts[i].name, toString(facts[i].kind), choice.reasons[i]));
  if (!choice.index)
    throw Error(request.requireGpu ? ErrorCode::GpuRequired : ErrorCode::NoUsableDevice,
                fmt::format("no usable Vulkan device: {}", fmt::join(reasons, ", ")));
  const auto chosen = reasons.begin() + *choice.index;
  *chosen += fmt::format(", driver {}", facts[*choice.index].driver);
  std::rotate(reasons.begin(), chosen, chosen + 1);
  return {std::make_unique<Device>(physical[*choice.index], facts[*choice.index]), std::move(reasons)};
}

}  // namespace asdfvk
