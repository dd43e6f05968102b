#pragma once

#include <doctest/doctest.h>

#include <memory>

#include "support/requested_device.h"
#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk::test {

/// Whether the device has the storage buffers that the solvers need, eight; the minimum of Vulkan is four.
inline bool hasBuffersForSolvers(const Device& device) {
  const uint32_t count = device.facts().maxStorageBuffersPerStage;
  if (count < 8) MESSAGE("without solvers on the device, which has " << count << " storage buffers");
  return count >= 8;
}

/// The best Vulkan device of this machine under core and synchronization validation. Its end is the check that the
/// layers reported nothing; tests/vk has the control that proves that they report errors.
class ValidatedDevice {
 public:
  ValidatedDevice() : ValidatedDevice(openBest) {}
  /// change(facts): changes what describeDevice() found of the first device.
  template <typename Change>
  [[nodiscard]] static ValidatedDevice changed(const Change& change) {
    return ValidatedDevice([&](const Instance& instance) {
      const VkPhysicalDevice physical = instance.physicalDevices().front();
      DeviceFacts facts = describeDevice(physical);
      change(facts);
      return std::make_unique<Device>(physical, facts);
    });
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
  template <typename Open>
  explicit ValidatedDevice(const Open& open)
      : instance_(std::make_unique<Instance>(InstanceOptions{.validation = true})),
        log_(instance_->validationLog()),
        device_(open(*instance_)) {}

  static std::unique_ptr<Device> openBest(const Instance& instance) {
    OpenedDevice opened = openDevice(instance, {});
    MESSAGE(opened.reasons.front());
    requireRequestedDevice(opened.reasons.front());
    return std::move(opened.device);
  }

  std::unique_ptr<Instance> instance_;
  std::shared_ptr<ValidationLog> log_;
  std::unique_ptr<Device> device_;
};

/// For ValidatedDevice::changed(): memory of the device that the host cannot map.
inline void useSeparateMemory(DeviceFacts& facts) { facts.mapsDeviceMemory = false; }

}  // namespace asdfvk::test
