#pragma once

#include <doctest/doctest.h>

#include <memory>

#include "support/requested_device.h"
#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk::test {

/// Whether the device has the storage buffers that the solvers need, eight; Vulkan promises four.
inline bool hasBuffersForSolvers(const Device& device) {
  const uint32_t count = device.facts().maxStorageBuffersPerStage;
  if (count < 8) MESSAGE("without solvers on the device, which has " << count << " storage buffers");
  return count >= 8;
}

/// The best Vulkan device of this machine under core and synchronization validation. Its end is the check that the
/// layers reported nothing; tests/vk has the control that proves that they report errors.
class ValidatedDevice {
 public:
  ValidatedDevice()
      : instance_(std::make_unique<Instance>(InstanceOptions{.validation = true})), log_(instance_->validationLog()) {
    OpenedDevice opened = openDevice(*instance_, {});
    MESSAGE(opened.reasons.front());
    requireRequestedDevice(opened.reasons.front());
    device_ = std::move(opened.device);
  }
  ~ValidatedDevice() {
    device_.reset();
    instance_.reset();
    for (const std::string& message : log_->messages()) FAIL_CHECK(message);
  }
  ValidatedDevice(const ValidatedDevice&) = delete;
  ValidatedDevice& operator=(const ValidatedDevice&) = delete;

  [[nodiscard]] Device& operator*() const { return *device_; }
  [[nodiscard]] Device* operator->() const { return device_.get(); }

 private:
  std::unique_ptr<Instance> instance_;
  std::shared_ptr<ValidationLog> log_;
  std::unique_ptr<Device> device_;
};

}  // namespace asdfvk::test
