#pragma once

#include <volk.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>

#include "vk/device_choice.h"

namespace asdfvk {

/// A VkDevice with compute queues. Several threads use it at the same time, each with a Device.
class LogicalDevice {
 public:
  /// Opens as many queues as the family has, but at most `maxQueueCount`. Precondition: `facts` describes `physical`
  /// and has a compute queue family. Throws Error{Device}.
  LogicalDevice(VkPhysicalDevice physical, DeviceFacts facts, uint32_t maxQueueCount = 1);

  /// A queue of Vulkan, to which several threads submit.
  class Queue {
   public:
    explicit Queue(VkQueue queue) : queue_(queue) {}
    [[nodiscard]] VkResult submit(const VkSubmitInfo& info, VkFence fence);

   private:
    VkQueue queue_;
    std::mutex mutex_;
  };

  [[nodiscard]] VkDevice handle() const { return device_.get(); }
  [[nodiscard]] const DeviceFacts& facts() const { return facts_; }
  /// Returns the queues in turn. Thread-safe.
  [[nodiscard]] Queue& nextQueue() { return queues_[queueIndex_++ % queues_.size()]; }
  /// Whether a call of any thread found that the device is lost. No further work can be submitted to a lost device.
  [[nodiscard]] bool isLost() const { return isLost_; }
  /// result: of a call that finds a lost device.
  void note(VkResult result) {
    if (result == VK_ERROR_DEVICE_LOST) isLost_ = true;
  }
  [[nodiscard]] const VkPhysicalDeviceMemoryProperties& memoryTypes() const { return memoryTypes_; }

 private:
  struct Destroy {
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
  };

  DeviceFacts facts_;
  VkPhysicalDeviceMemoryProperties memoryTypes_{};
  std::unique_ptr<VkDevice_T, Destroy> device_;
  std::deque<Queue> queues_;
  std::atomic<uint32_t> queueIndex_ = 0;
  std::atomic<bool> isLost_ = false;
};

}  // namespace asdfvk
