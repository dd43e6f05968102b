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
  /// Precondition: finishAll() was called.
  ~UploadQueue();
  UploadQueue(const UploadQueue&) = delete;
  UploadQueue& operator=(const UploadQueue&) = delete;

  /// Calls write() with staging memory of `byteCount` bytes, at most kMaxPieceByteCount, and submits the copy to
  /// `target`. Throws Error of kind Device.
  void add(const Buffer& target, uint64_t offset, uint64_t byteCount, FunctionRef<void(std::span<std::byte>)> write);
  /// Waits for the copies to a buffer, which may then be destroyed.
  void finish(VkBuffer target) noexcept;
  /// Frees the staging memory of the copies that have ended.
  void releaseEnded() noexcept;
  /// Waits for all copies.
  void finishAll() noexcept;

 private:
  struct Upload;

  void takeFirst() noexcept;

  const Device& device_;
  std::deque<std::unique_ptr<Upload>> pending_;  // In the order of submission, which is that of their ends.
};

}  // namespace asdfvk
