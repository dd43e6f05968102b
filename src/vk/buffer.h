#pragma once

#include <volk.h>

#include <cstddef>
#include <span>

#include "vk/device.h"

namespace asdfvk {

enum class MemoryKind {
  DeviceLocal,  ///< Fastest for kernels; also mapped where device and host share memory.
  DeviceOnly,   ///< Never mapped, as on a device with separate memory; for tests.
  HostVisible,  ///< Mapped and coherent; cached where the device has such memory.
};

/// A buffer with memory of the best type that has enough left. Throws Error{OutOfDeviceMemory, DeviceLimit}.
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Device& device, uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  [[nodiscard]] VkBuffer handle() const { return buffer_; }
  [[nodiscard]] uint64_t byteCount() const { return byteCount_; }
  /// Null where the host cannot access the memory.
  [[nodiscard]] std::byte* mapped() const { return mapped_; }
  /// Whether reads of mapped() are cached. Uncached reads are about 100 times slower.
  [[nodiscard]] bool isCached() const { return isCached_; }
  template <typename T>
  [[nodiscard]] std::span<T> mappedAs() const {
    return {reinterpret_cast<T*>(mapped_), static_cast<size_t>(byteCount_ / sizeof(T))};
  }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  uint64_t byteCount_ = 0;
  std::byte* mapped_ = nullptr;
  bool isCached_ = false;
};

/// Throws Error{DeviceLimit} where a storage buffer of that size exceeds DeviceFacts::maxStorageBufferRange.
void requireStorageRange(const Device& device, uint64_t byteCount);

/// A view of a whole buffer as rgba32ui texels (16 bytes each). The buffer must have been made with
/// VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT and must outlive the view.
class TexelView {
 public:
  TexelView() = default;
  TexelView(const Device& device, const Buffer& buffer);
  ~TexelView();
  TexelView(TexelView&& other) noexcept;
  TexelView& operator=(TexelView&& other) noexcept;

  [[nodiscard]] VkBufferView handle() const { return view_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  VkBufferView view_ = VK_NULL_HANDLE;
};

/// Copies between host memory and buffers that are not mapped pass through mapped memory in pieces of this size.
inline constexpr uint64_t kMaxPieceByteCount = 8u << 20;

/// A device-local buffer filled with `bytes`. At least 16 bytes are allocated, because an empty buffer cannot be bound.
[[nodiscard]] Buffer uploadBuffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                                  MemoryKind kind = MemoryKind::DeviceLocal);

/// Copies the first bytes of a buffer (made with VK_BUFFER_USAGE_TRANSFER_SRC_BIT) to the host.
void downloadBuffer(const Device& device, const Buffer& buffer, std::span<std::byte> bytes);

}  // namespace asdfvk
