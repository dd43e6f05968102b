#pragma once

#include <volk.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vk/device_choice.h"
#include "vk/instance.h"

namespace asdfvk {

class BufferPool;

/// The first queue family with compute and without graphics; if there is none, the first family with compute. A family
/// without graphics does not delay the desktop, and on some systems has a longer watchdog timeout.
[[nodiscard]] std::optional<uint32_t> chooseComputeQueueFamily(std::span<const VkQueueFamilyProperties> families);

[[nodiscard]] DeviceFacts describeDevice(VkPhysicalDevice device);

/// A logical device with one compute queue. Not thread-safe.
class Device {
 public:
  /// Precondition: `facts` describes `physical` and has a compute queue family. Throws Error{Device}.
  Device(VkPhysicalDevice physical, DeviceFacts facts);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] VkDevice handle() const { return device_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] VkCommandPool commandPool() const { return commandPool_; }
  [[nodiscard]] const DeviceFacts& facts() const { return facts_; }
  [[nodiscard]] BufferPool& pool() const { return *pool_; }
  /// The first type among `allowedTypes` with all flags of `wanted`.
  [[nodiscard]] std::optional<uint32_t> findMemoryType(uint32_t allowedTypes, VkMemoryPropertyFlags wanted) const;
  [[nodiscard]] VkMemoryPropertyFlags memoryFlags(uint32_t type) const {
    return memory_.memoryTypes[type].propertyFlags;
  }

 private:
  DeviceFacts facts_;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool commandPool_ = VK_NULL_HANDLE;
  std::unique_ptr<BufferPool> pool_;
};

struct OpenedDevice {
  std::unique_ptr<Device> device;
  /// Has a line per device: its name and the decision. The opened device is first, with its driver.
  std::vector<std::string> reasons;
};

/// Opens the device that chooseDevice() selects. Throws Error{Device} with the reasons of all refusals in one line.
[[nodiscard]] OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request);

}  // namespace asdfvk
