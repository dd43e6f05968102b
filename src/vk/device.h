#pragma once

#include <volk.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/device_seconds.h"
#include "vk/command_pool.h"
#include "vk/descriptor_sets.h"
#include "vk/device_choice.h"
#include "vk/instance.h"
#include "vk/memory_arena.h"
#include "vk/memory_types.h"

namespace asdfvk {

class UploadQueue;

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

  [[nodiscard]] VkDevice handle() const { return device_.get(); }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] const DeviceFacts& facts() const { return facts_; }
  [[nodiscard]] MemoryArena& memory() const { return *memory_; }
  [[nodiscard]] DescriptorSets& descriptorSets() const { return *descriptorSets_; }
  [[nodiscard]] CommandPool& commandPool() const { return *commandPool_; }
  [[nodiscard]] UploadQueue& uploads() const { return *uploads_; }
  /// The time of all submissions for which the host has waited; 0 on a device without timestamps.
  [[nodiscard]] const DeviceSeconds& seconds() const { return seconds_; }
  void addSeconds(const DeviceSeconds& further) const { seconds_ += further; }
  [[nodiscard]] const VkPhysicalDeviceMemoryProperties& memoryTypes() const { return memoryTypes_; }
  [[nodiscard]] VkMemoryPropertyFlags memoryFlags(uint32_t type) const {
    return memoryTypes_.memoryTypes[type].propertyFlags;
  }

 private:
  DeviceFacts facts_;
  struct Destroy {
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
  };

  VkPhysicalDeviceMemoryProperties memoryTypes_{};
  std::unique_ptr<VkDevice_T, Destroy> device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  mutable DeviceSeconds seconds_;
  // Members are destroyed in reverse order: uploads use the others.
  std::unique_ptr<MemoryArena> memory_;
  std::unique_ptr<DescriptorSets> descriptorSets_;
  std::unique_ptr<CommandPool> commandPool_;
  std::unique_ptr<UploadQueue> uploads_;
};

struct OpenedDevice {
  std::unique_ptr<Device> device;
  /// Has a line per device: its name and the decision. The opened device is first, with its driver.
  std::vector<std::string> reasons;
};

/// Opens the device that chooseDevice() selects. Throws Error{Device} with the reasons of all refusals in one line.
[[nodiscard]] OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request);

}  // namespace asdfvk
