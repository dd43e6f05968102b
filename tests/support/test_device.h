#pragma once

#include <doctest/doctest.h>

#include <memory>

#include "support/requested_device.h"
#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk::test {

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
