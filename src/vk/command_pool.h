#pragma once

#include <volk.h>

#include <vector>

#include "vk/device_choice.h"

namespace asdfvk {

/// What one submission needs.
struct SubmissionObjects {
  static constexpr uint32_t kMaxTimestampCount = 32;

  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;           ///< Not signalled.
  VkQueryPool timestamps = VK_NULL_HANDLE;  ///< Null on a device without timestamps.
};

/// These objects of a device, which later submissions use again.
class CommandPool {
 public:
  /// The constructor makes as many as a computation has in flight, however slow the device is.
  static constexpr size_t kFirstCount = 16;

  /// Throws Error of kind Device.
  CommandPool(VkDevice device, const DeviceFacts& facts);
  ~CommandPool();
  CommandPool(const CommandPool&) = delete;
  CommandPool& operator=(const CommandPool&) = delete;

  [[nodiscard]] SubmissionObjects take();
  /// Precondition: the submission has ended.
  void give(const SubmissionObjects& objects) noexcept;

 private:
  [[nodiscard]] SubmissionObjects make();
  void destroy(const SubmissionObjects& objects) noexcept;
  void destroyAll() noexcept;

  VkDevice device_;
  bool hasTimestamps_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::vector<SubmissionObjects> idle_;
};

}  // namespace asdfvk
