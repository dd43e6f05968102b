#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk {

struct OpenedDevice {
  std::unique_ptr<Device> device;
  /// One line per device with its name and the decision; the opened one first, with its driver.
  std::vector<std::string> reasons;
};

/// Opens the device that chooseDevice() returns. Throws Error{Device} with the reasons of all refusals in one line.
[[nodiscard]] OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request);

}  // namespace asdfvk
