#pragma once

#include <volk.h>

#include <memory>
#include <string>
#include <vector>

#include "core/device_seconds.h"
#include "vk/command_pool.h"
#include "vk/descriptor_sets.h"
#include "vk/device_choice.h"
#include "vk/instance.h"
#include "vk/logical_device.h"
#include "vk/memory_arena.h"
#include "vk/memory_types.h"
#include "vk/physical_device.h"

namespace asdfvk {

class UploadQueue;

/// A logical device with memory, descriptor sets and command buffers for one thread. Not thread-safe.
class Device {
 public:
  /// Throws Error{Device}.
  explicit Device(std::shared_ptr<LogicalDevice> logical);
  /// Opens the logical device.
  Device(VkPhysicalDevice physical, DeviceFacts facts);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] VkDevice handle() const { return logical_->handle(); }
  [[nodiscard]] const DeviceFacts& facts() const { return logical_->facts(); }
  [[nodiscard]] MemoryArena& memory() const { return *memory_; }
  [[nodiscard]] DescriptorSets& descriptorSets() const { return *descriptorSets_; }
  [[nodiscard]] CommandPool& commandPool() const { return *commandPool_; }
  [[nodiscard]] UploadQueue& uploads() const { return *uploads_; }
  /// Throws Error{Device} if the device is lost.
  void submit(const VkSubmitInfo& info, VkFence fence) const;
  /// result: of a wait. Throws Error{Device} if the device is lost.
  void requireWaited(VkResult result) const;
  /// The time of all submissions for which the host has waited; 0 on a device without timestamps.
  [[nodiscard]] const DeviceSeconds& seconds() const { return seconds_; }
  void addSeconds(const DeviceSeconds& further) const { seconds_ += further; }
  [[nodiscard]] const VkPhysicalDeviceMemoryProperties& memoryTypes() const { return logical_->memoryTypes(); }
  [[nodiscard]] VkMemoryPropertyFlags memoryFlags(uint32_t type) const {
    return memoryTypes().memoryTypes[type].propertyFlags;
  }

 private:
  std::shared_ptr<LogicalDevice> logical_;
  LogicalDevice::Queue& queue_;
  mutable DeviceSeconds seconds_;
  // Members are destroyed in reverse order: uploads use the others.
  std::unique_ptr<MemoryArena> memory_;
  std::unique_ptr<DescriptorSets> descriptorSets_;
  std::unique_ptr<CommandPool> commandPool_;
  std::unique_ptr<UploadQueue> uploads_;
};

template <typename Opened>
struct OpenedOn {
  Opened device;
  /// Has a line per device: its name and the decision. The opened device is first, with its driver.
  std::vector<std::string> reasons;
};
using OpenedDevice = OpenedOn<std::unique_ptr<Device>>;
using OpenedLogicalDevice = OpenedOn<std::shared_ptr<LogicalDevice>>;

/// Opens the device that chooseDevice() selects. Throws Error{Device} with the reasons of all refusals in one line.
[[nodiscard]] OpenedLogicalDevice openLogicalDevice(const Instance& instance, const DeviceRequest& request,
                                                    uint32_t maxQueueCount = 1);
[[nodiscard]] OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request);

}  // namespace asdfvk
