#include "vk/upload_queue.h"

#include <algorithm>

#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxPendingCount = 8;

}  // namespace

struct UploadQueue::Upload {
  Upload(const Device& device, uint64_t byteCount, VkBuffer to)
      : target(to),
        staging(device, byteCount, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::HostVisible),
        commands(device) {}

  VkBuffer target;
  Buffer staging;
  CommandList commands;  // Destroyed first; its destructor waits.
};

UploadQueue::UploadQueue(const Device& device) : device_(device) {}

UploadQueue::~UploadQueue() = default;

void UploadQueue::finishAll() noexcept {
  while (!pending_.empty()) takeFirst();
}

void UploadQueue::releaseEnded() noexcept {
  while (!pending_.empty() && pending_.front()->commands.hasEnded()) takeFirst();
}

/// Removes the upload before it is destroyed, because the destructor of its buffer calls finish().
void UploadQueue::takeFirst() noexcept {
  const std::unique_ptr<Upload> first = std::move(pending_.front());
  pending_.pop_front();
}

void UploadQueue::add(const Buffer& target, uint64_t offset, uint64_t byteCount,
                      FunctionRef<void(std::span<std::byte>)> write) {
  releaseEnded();
  if (pending_.size() == kMaxPendingCount) {
    pending_.front()->commands.wait();
    takeFirst();
  }
  auto upload = std::make_unique<Upload>(device_, byteCount, target.handle());
  write({upload->staging.mapped(), byteCount});
  upload->commands.begin();
  upload->commands.copy(upload->staging, 0, target, offset, byteCount);
  upload->commands.barrier();
  upload->commands.submit();
  pending_.push_back(std::move(upload));
}

void UploadQueue::finish(VkBuffer target) noexcept {
  const auto last = std::find_if(pending_.rbegin(), pending_.rend(),
                                 [&](const std::unique_ptr<Upload>& upload) { return upload->target == target; });
  if (last != pending_.rend()) (*last)->commands.finish();
}

}  // namespace asdfvk
