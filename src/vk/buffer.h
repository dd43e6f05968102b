#pragma once

#include <volk.h>

#include <cstddef>
#include <span>
#include <type_traits>

#include "core/function_ref.h"
#include "vk/device.h"
#include "vk/memory_types.h"

namespace asdfvk {

/// A buffer with memory of the best type that has enough left, and with unspecified contents. The destructor waits for
/// uploads; no other submitted work may use the buffer. Throws Error{OutOfDeviceMemory, DeviceLimit}.
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Device& device, uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  [[nodiscard]] bool exists() const { return buffer_ != VK_NULL_HANDLE; }
  [[nodiscard]] VkBuffer handle() const { return buffer_; }
  [[nodiscard]] uint64_t byteCount() const { return byteCount_; }
  /// Null if the host cannot access the memory.
  [[nodiscard]] std::byte* mapped() const { return mapped_; }
  /// Whether reads of mapped() are cached. Uncached reads are about 100 times slower.
  [[nodiscard]] bool isCached() const { return isCached_; }
  template <typename T>
  [[nodiscard]] std::span<T> mappedAs() const {
    return {reinterpret_cast<T*>(mapped_), static_cast<size_t>(byteCount_ / sizeof(T))};
  }

 private:
  const Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  MemoryArena::Range memory_;
  uint64_t byteCount_ = 0;
  std::byte* mapped_ = nullptr;
  bool isCached_ = false;
};

/// Throws Error{DeviceLimit} for more bytes than DeviceFacts::maxStorageBufferRange.
void requireStorageRange(const Device& device, uint64_t byteCount);

/// A whole buffer, with VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT, as rgba32ui texels. The buffer must outlive the view.
class TexelView {
 public:
  TexelView(const Device& device, const Buffer& buffer);
  ~TexelView() { vkDestroyBufferView(device_, view_, nullptr); }
  TexelView(const TexelView&) = delete;
  TexelView& operator=(const TexelView&) = delete;

  [[nodiscard]] VkBufferView handle() const { return view_; }

 private:
  VkDevice device_;
  VkBufferView view_ = VK_NULL_HANDLE;
};

/// Piece size of copies between host memory and buffers that are not mapped.
inline constexpr uint64_t kMaxPieceByteCount = 8u << 20;

/// A buffer with the given bytes, but at least 16 bytes, because an empty buffer cannot be bound.
[[nodiscard]] Buffer uploadBuffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                                  MemoryKind kind = MemoryKind::Uploaded);

/// Writes consecutive items to `bytes`; `first` is the number of the first of them. Several threads call it at the same
/// time. The memory may be uncached: the function writes every byte, in ascending order, and reads none.
using WriteItems = FunctionRef<void(size_t first, std::span<std::byte> bytes)>;
/// Like uploadBuffer(), but `write` writes the items to the mapped memory of the buffer. If the buffer is not mapped,
/// `write` writes pieces of whole items to staging memory. An item has at most kMaxPieceByteCount bytes.
[[nodiscard]] Buffer uploadWritten(const Device& device, size_t itemCount, size_t itemByteCount,
                                   VkBufferUsageFlags usage, MemoryKind kind, const WriteItems& write);

/// Like uploadWritten(), with typed items: write(first, std::span<Item>).
template <typename Item, typename Write>
[[nodiscard]] Buffer uploadItems(const Device& device, size_t itemCount, VkBufferUsageFlags usage, const Write& write) {
  static_assert(std::is_trivially_copyable_v<Item>);
  return uploadWritten(device, itemCount, sizeof(Item), usage, MemoryKind::Uploaded,
                       [&](size_t first, std::span<std::byte> bytes) {
                         write(first, std::span(reinterpret_cast<Item*>(bytes.data()), bytes.size() / sizeof(Item)));
                       });
}

/// Copies the first bytes of a buffer with VK_BUFFER_USAGE_TRANSFER_SRC_BIT to the host, after all submitted work.
void downloadBuffer(const Device& device, const Buffer& buffer, std::span<std::byte> bytes);

}  // namespace asdfvk
