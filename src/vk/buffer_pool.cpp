#include "vk/buffer_pool.h"

#include <utility>

namespace asdfvk {

uint64_t BufferPool::idleByteCount() const {
  uint64_t count = 0;
  for (const Entry& entry : idle_) count += entry.buffer.byteCount();
  return count;
}

BufferPool::Entry BufferPool::take(uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind) {
  auto best = idle_.end();
  for (auto entry = idle_.begin(); entry != idle_.end(); ++entry) {
    const uint64_t size = entry->buffer.byteCount();
    if (entry->usage == usage && entry->kind == kind && size >= byteCount &&
        (best == idle_.end() || size < best->buffer.byteCount()))
      best = entry;
  }
  if (best == idle_.end()) return {Buffer(device_, byteCount, usage, kind), usage, kind};
  Entry taken = std::move(*best);
  idle_.erase(best);
  return taken;
}

void BufferPool::give(Entry entry) noexcept {
  if (idleByteCount() + entry.buffer.byteCount() > kMaxIdleByteCount) return;
  try {
    idle_.push_back(std::move(entry));
  } catch (...) {  // The host has no memory for the entry. The buffer is freed instead.
  }
}

}  // namespace asdfvk
