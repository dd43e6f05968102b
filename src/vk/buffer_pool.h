#pragma once

#include <cstdint>
#include <vector>

#include "vk/buffer.h"

namespace asdfvk {

/// Buffers of a device that are not in use, kept for later computations: a driver of a GPU takes up to milliseconds to
/// allocate memory. PooledBuffer takes them and gives them back.
class BufferPool {
 public:
  /// Further buffers are freed.
  static constexpr uint64_t kMaxIdleByteCount = 256u << 20;

  /// The device must outlive it.
  explicit BufferPool(const Device& device) : device_(device) {}

  [[nodiscard]] uint64_t idleByteCount() const;
  void clear() { idle_.clear(); }

 private:
  friend class PooledBuffer;

  struct Entry {
    Buffer buffer;
    VkBufferUsageFlags usage = 0;
    MemoryKind kind = MemoryKind::DeviceLocal;
  };

  [[nodiscard]] Entry take(uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind);
  void give(Entry entry) noexcept;

  const Device& device_;
  std::vector<Entry> idle_;
};

/// A buffer of Device::pool(), with contents of earlier users. Its destructor gives it back; then no submitted work may
/// use it.
class PooledBuffer {
 public:
  PooledBuffer() = default;
  /// A buffer of byteCount bytes or more. Throws as Buffer::Buffer().
  PooledBuffer(const Device& device, uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind)
      : pool_(&device.pool()), entry_(device.pool().take(byteCount, usage, kind)) {}
  ~PooledBuffer() {
    if (pool_ != nullptr) pool_->give(std::move(entry_));
  }
  PooledBuffer(PooledBuffer&& other) noexcept { *this = std::move(other); }
  PooledBuffer& operator=(PooledBuffer&& other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(entry_, other.entry_);
    return *this;
  }

  [[nodiscard]] const Buffer& operator*() const { return entry_.buffer; }
  [[nodiscard]] const Buffer* operator->() const { return &entry_.buffer; }
  [[nodiscard]] bool exists() const { return pool_ != nullptr; }

 private:
  BufferPool* pool_ = nullptr;
  BufferPool::Entry entry_;
};

}  // namespace asdfvk
