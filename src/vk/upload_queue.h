#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "core/function_ref.h"
#include "vk/buffer.h"

namespace asdfvk {

class CommandList;

/// Copies to buffers that the host cannot access, through staging memory. The host writes the next piece while the
/// device copies earlier ones. Later submissions see the copies.
class UploadQueue {
 public:
  /// The device must outlive the queue.
  explicit UploadQueue(const Device& device);
  /// Waits for all copies.
  ~UploadQueue();
  UploadQueue(const UploadQueue&) = delete;
  UploadQueue& operator=(const UploadQueue&) = delete;

  /// Calls write() with staging memory of `byteCount` bytes, at most kMaxPieceByteCount, and submits the copy to
  /// `target`. Throws Error of kind Device.
  void add(const Buffer& target, uint64_t offset, uint64_t byteCount, FunctionRef<void(std::span<std::byte>)> write);
  /// Waits for the copies to a buffer, which may then be destroyed.
  void finish(VkBuffer target) noexcept;

 private:
  struct Upload;

  void takeFirst();

  const Device& device_;
  std::deque<std::unique_ptr<Upload>> pending_;  // In the order of submission, which is that of their ends.
  uint64_t pendingByteCount_ = 0;
};

}  // namespace asdfvk
