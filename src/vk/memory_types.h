#pragma once

#include <volk.h>

#include <cstdint>
#include <vector>

namespace asdfvk {

enum class MemoryKind {
  DeviceLocal,  ///< Fastest for kernels; also mapped if device and host share memory.
  Uploaded,     ///< Like DeviceLocal; also mapped if the host can access all memory of the device over the bus.
  DeviceOnly,   ///< Never mapped, as on a device with separate memory; for tests.
  HostVisible,  ///< Mapped and coherent; cached if the device has such memory.
};

/// Flags of the memory types that the host accesses.
inline constexpr VkMemoryPropertyFlags kMappableMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

/// Greatest part of the memory of a device that the host accesses through a window, shared with other programs. In the
/// memory of a larger heap (resizable BAR), the host writes uploads directly.
inline constexpr uint64_t kMaxWindowByteCount = 256u << 20;

/// The memory types that may hold a buffer of `byteCount` bytes, the best first. allowed:
/// VkMemoryRequirements::memoryTypeBits. A pure function.
[[nodiscard]] std::vector<uint32_t> rankMemoryTypes(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                                    MemoryKind kind, uint64_t byteCount);

}  // namespace asdfvk
