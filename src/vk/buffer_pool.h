#pragma once

#include <cstdint>
#include <vector>

#include "vk/buffer.h"

namespace asdfvk {

/// Unused buffers of a device, kept because a GPU driver takes up to milliseconds to allocate memory. PooledBuffer
/// takes buffers from the pool and returns them.
class BufferPool {
 public:
  /// Greatest memory of all buffers in the pool. Further buffers are freed.
  static constexpr uint64_t kMaxIdleByteCount = 256u << 20;

  /// The device must outlive the pool.
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

/// A buffer of Device::pool(), with the contents of earlier users. The destructor returns the buffer to the pool.
/// Precondition of the destructor: no submitted work uses the buffer.
class PooledBuffer {
 public:
  PooledBuffer() = default;
  /// byteCount: the buffer may be larger. Throws the errors of Buffer::Buffer().
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
