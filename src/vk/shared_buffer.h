#pragma once

#include <span>

#include "vk/buffer.h"
#include "vk/command_list.h"

namespace asdfvk {

/// A buffer on the device. The host accesses a mapped buffer directly. The host accesses any other buffer
/// through a mapped copy.
class SharedBuffer {
 public:
  enum class Host { Writes, Reads };

  /// usage: for kernels. host: whether the host writes or reads the buffer.
  SharedBuffer(const Device& device, uint64_t byteCount, VkBufferUsageFlags usage, Host host)
      : device_(device),
        buffer_(device, byteCount,
                usage | (host == Host::Writes ? VK_BUFFER_USAGE_TRANSFER_DST_BIT : VK_BUFFER_USAGE_TRANSFER_SRC_BIT),
                host == Host::Writes ? MemoryKind::Uploaded : MemoryKind::DeviceLocal),
        isDirect_(buffer_.mapped() != nullptr && (host == Host::Writes || buffer_.isCached())),
        host_(host) {}

  [[nodiscard]] const Buffer& onDevice() const { return buffer_; }

  /// Memory for the host. The first call of onHost() or recordCopy() creates the mapped copy if it is needed.
  template <typename T>
  [[nodiscard]] std::span<T> onHost() {
    return hostBuffer().mappedAs<T>();
  }

  /// Records the copy of the first byteCount bytes, in the direction that `host` of the constructor states. Records
  /// nothing if the host accesses the buffer directly. The caller records a barrier before the copy, for the writes of
  /// kernels, and another one after the copy.
  void recordCopy(CommandList& commands, uint64_t byteCount) {
    if (isDirect_) return;
    const Buffer& host = hostBuffer();
    if (host_ == Host::Writes)
      commands.copy(host, 0, buffer_, 0, byteCount);
    else
      commands.copy(buffer_, 0, host, 0, byteCount);
  }

 private:
  [[nodiscard]] const Buffer& hostBuffer() {
    if (isDirect_) return buffer_;
    if (!copy_.exists())
      copy_ = Buffer(device_, buffer_.byteCount(),
                     host_ == Host::Writes ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT : VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     MemoryKind::HostVisible);
    return copy_;
  }

  const Device& device_;
  Buffer buffer_, copy_;
  bool isDirect_;
  Host host_;
};

}  // namespace asdfvk
