#include "asdf_vk/error.h"
#include "pipeline/asdf.h"
#include "vk/device.h"

namespace asdfvk {

std::vector<DeviceInfo> listDevices(std::string* reason) {
  std::vector<DeviceInfo> devices;
  try {
    const Instance instance;
    std::vector<DeviceFacts> facts;
    for (const VkPhysicalDevice device : instance.physicalDevices()) facts.push_back(describeDevice(device));
    const DeviceChoice choice = chooseDevice(facts, {});
    for (size_t i = 0; i < facts.size(); ++i) {
      const bool usable = chooseDevice(std::span(&facts[i], 1), {}).index.has_value();
      devices.push_back(
          {facts[i].name, facts[i].driver, std::string(toString(facts[i].kind)), usable, choice.reasons[i]});
    }
  } catch (const Error& error) {
    if (reason != nullptr) *reason = error.what();
  }
  return devices;
}

}  // namespace asdfvk
