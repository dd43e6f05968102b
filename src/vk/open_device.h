#pragma once

#include <memory>
#include <string>

#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk {

struct OpenedDevice {
  std::unique_ptr<Device> device;
  std::string reason;  ///< One line: the device and why it was chosen, with the driver.
};

/// Opens the device that chooseDevice() picks. Throws Error{Device} with the reason of every refusal in one line.
[[nodiscard]] OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request);

}  // namespace asdfvk
