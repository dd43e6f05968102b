#include "vk/memory_types.h"

#include <span>

namespace asdfvk {
namespace {

using Flags = VkMemoryPropertyFlags;

// Memory with these properties needs a feature that is not enabled, or is for other resources.
constexpr Flags kSpecial = VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
                           VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_RDMA_CAPABLE_BIT_NV;
constexpr Flags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

constexpr Flags kWindow = kLocal | kMappableMemory;
constexpr Flags kForKernels[] = {kLocal | kMappableMemory | kCached, kLocal, 0},
                kForUploads[] = {kLocal | kMappableMemory | kCached, kWindow, kLocal, 0},
                kForHost[] = {kMappableMemory | kCached, kMappableMemory};

std::span<const Flags> preferencesFor(MemoryKind kind) {
  if (kind == MemoryKind::HostVisible) return kForHost;
  return kind == MemoryKind::Uploaded ? std::span<const Flags>(kForUploads) : kForKernels;
}

}  // namespace

std::vector<uint32_t> rankMemoryTypes(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, MemoryKind kind,
                                      uint64_t byteCount) {
  std::vector<uint32_t> ranked;
  for (const Flags wanted : preferencesFor(kind))
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      const auto [flags, heapIndex] = memory.memoryTypes[i];
      const uint64_t heapByteCount = memory.memoryHeaps[heapIndex].size;
      if ((allowed & (1u << i)) == 0 || (flags & kSpecial) != 0 || (flags & wanted) != wanted) continue;
      if (wanted == kWindow && (heapByteCount <= kMaxWindowByteCount || byteCount > heapByteCount / 4)) continue;
      ranked.push_back(i);
      allowed &= ~(1u << i);
    }
  return ranked;
}

}  // namespace asdfvk
