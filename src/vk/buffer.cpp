#include "vk/buffer.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/huge_pages.h"
#include "core/parallel.h"
#include "vk/buffer_pool.h"
#include "vk/command_list.h"
#include "vk/result.h"

namespace asdfvk {
namespace {

constexpr VkMemoryPropertyFlags kMappable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

/// The memory types that may hold a buffer of the given kind, the best first.
std::vector<uint32_t> rankMemoryTypes(const Device& device, uint32_t allowed, MemoryKind kind) {
  using Flags = VkMemoryPropertyFlags;
  const Flags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const Flags preferences[2][3] = {{local | kMappable | cached, local, 0}, {kMappable | cached, kMappable, kMappable}};
  std::vector<uint32_t> ranked;
  for (const Flags wanted : preferences[kind == MemoryKind::HostVisible ? 1 : 0])
    while (const auto type = device.findMemoryType(allowed, wanted)) {
      ranked.push_back(*type);
      allowed &= ~(1u << *type);
    }
  return ranked;
}

MemoryKind kindOn(const Device& device, MemoryKind kind) {
  return kind == MemoryKind::DeviceLocal && !device.facts().mapsDeviceMemory ? MemoryKind::DeviceOnly : kind;
}

/// Allocates memory of the first type that has enough left. Returns the result of the last attempt.
VkResult allocate(const Device& device, VkMemoryAllocateInfo& info, std::span<const uint32_t> types,
                  VkDeviceMemory& memory) {
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (const uint32_t type : types) {
    info.memoryTypeIndex = type;
    result = vkAllocateMemory(device.handle(), &info, nullptr, &memory);
    if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY) break;
  }
  return result;
}

/// Writes items on several threads. One thread does not saturate the memory, and the first write to a page of new
/// memory takes longer than a copy. first: the first item of `bytes`.
void writeInParallel(std::span<std::byte> bytes, size_t first, size_t itemByteCount, const WriteItems& write) {
  constexpr size_t kBlockByteCount = size_t{1} << 20;
  const size_t blockItemCount = std::max<size_t>(1, kBlockByteCount / itemByteCount),
               blockByteCount = blockItemCount * itemByteCount;
  forEachTask((bytes.size() + blockByteCount - 1) / blockByteCount, [&](size_t block) {
    const std::span<std::byte> own = bytes.subspan(block * blockByteCount);
    write(first + block * blockItemCount, own.first(std::min(own.size(), blockByteCount)));
  });
}

/// Calls copyPiece(commands, staging, begin, byteCount) for each piece of whole items. staging: mapped memory for one
/// piece.
template <typename CopyPiece>
void forEachPiece(const Device& device, uint64_t byteCount, size_t itemByteCount, const CopyPiece& copyPiece) {
  constexpr uint64_t kMinPieceByteCount = 64u << 10;
  if (byteCount == 0) return;
  const uint64_t stagingByteCount = std::bit_ceil(std::clamp(byteCount, kMinPieceByteCount, kMaxPieceByteCount));
  const PooledBuffer staging(device, stagingByteCount,
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                             MemoryKind::HostVisible);
  CommandList commands(device);
  const uint64_t pieceByteCount = kMaxPieceByteCount / itemByteCount * itemByteCount;
  for (uint64_t begin = 0; begin < byteCount; begin += pieceByteCount)
    copyPiece(commands, *staging, begin, std::min(pieceByteCount, byteCount - begin));
}

}  // namespace

Buffer::Buffer(const Device& device, uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind)
    : device_(device.handle()), byteCount_(byteCount) {
  const uint64_t limit = device.facts().maxMemoryAllocationSize;
  if (limit > 0 && byteCount > limit)
    throw Error(ErrorCode::DeviceLimit, fmt::format("{} allows {} MiB in one buffer and the mesh needs {}",
                                                    device.facts().name, limit >> 20, (byteCount >> 20) + 1));
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = byteCount;
  info.usage = usage;
  requireSuccess(vkCreateBuffer(device_, &info, nullptr, &buffer_), "creating a buffer");
  Buffer guard = std::move(*this);  // If a later step throws, the guard frees the members that exist by then.

  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(guard.device_, guard.buffer_, &requirements);
  const std::vector<uint32_t> types = rankMemoryTypes(device, requirements.memoryTypeBits, kindOn(device, kind));
  if (types.empty())
    throw Error(ErrorCode::DeviceLimit, fmt::format("{} has no memory type for this buffer", device.facts().name));
  VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocation.allocationSize = requirements.size;
  VkResult allocated = allocate(device, allocation, types, guard.memory_);
  if (allocated == VK_ERROR_OUT_OF_DEVICE_MEMORY && device.pool().idleByteCount() > 0) {
    device.pool().clear();
    allocated = allocate(device, allocation, types, guard.memory_);
  }
  requireSuccess(allocated, fmt::format("allocating {} MiB on {}", (byteCount >> 20) + 1, device.facts().name));
  const VkMemoryPropertyFlags flags = device.memoryFlags(allocation.memoryTypeIndex);
  requireSuccess(vkBindBufferMemory(guard.device_, guard.buffer_, guard.memory_, 0), "binding memory");
  if (kindOn(device, kind) != MemoryKind::DeviceOnly && (flags & kMappable) == kMappable) {
    void* pointer = nullptr;
    requireSuccess(vkMapMemory(guard.device_, guard.memory_, 0, VK_WHOLE_SIZE, 0, &pointer), "mapping memory");
    guard.mapped_ = static_cast<std::byte*>(pointer);
    guard.isCached_ = (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
    // A CPU device uses memory of the process, which its driver allocates in small pages.
    if (device.facts().kind == DeviceKind::Cpu) requestHugePages(pointer, byteCount);
  }
  *this = std::move(guard);
}

Buffer::~Buffer() {
  if (!device_) return;
  vkDestroyBuffer(device_, buffer_, nullptr);
  vkFreeMemory(device_, memory_, nullptr);
}

Buffer::Buffer(Buffer&& other) noexcept { *this = std::move(other); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(byteCount_, other.byteCount_);
  std::swap(mapped_, other.mapped_);
  std::swap(isCached_, other.isCached_);
  return *this;
}

void requireStorageRange(const Device& device, uint64_t byteCount) {
  const DeviceFacts& facts = device.facts();
  if (byteCount > facts.maxStorageBufferRange)
    throw Error(ErrorCode::DeviceLimit,
                fmt::format("the mesh needs {} MiB in one storage buffer and {} allows {}", (byteCount >> 20) + 1,
                            facts.name, facts.maxStorageBufferRange >> 20));
}

TexelView::TexelView(const Device& device, const Buffer& buffer) : device_(device.handle()) {
  const uint64_t texelCount = buffer.byteCount() / 16;
  if (texelCount > device.facts().maxTexelBufferElements)
    throw Error(ErrorCode::DeviceLimit,
                fmt::format("the mesh needs {} texels in one buffer and {} allows {}", texelCount, device.facts().name,
                            device.facts().maxTexelBufferElements));
  VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
  info.buffer = buffer.handle();
  info.format = VK_FORMAT_R32G32B32A32_UINT;
  info.range = VK_WHOLE_SIZE;
  requireSuccess(vkCreateBufferView(device_, &info, nullptr, &view_), "creating a buffer view");
}

Buffer uploadBuffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage, MemoryKind kind) {
  return uploadWritten(device, bytes.size(), 1, usage, kind, [&](size_t first, std::span<std::byte> to) {
    std::memcpy(to.data(), &bytes[first], to.size());
  });
}

Buffer uploadWritten(const Device& device, size_t itemCount, size_t itemByteCount, VkBufferUsageFlags usage,
                     MemoryKind kind, const WriteItems& write) {
  ASDFVK_CHECK(itemByteCount > 0 && itemByteCount <= kMaxPieceByteCount);
  const uint64_t byteCount = uint64_t{itemCount} * itemByteCount;
  Buffer buffer(device, std::max<uint64_t>(byteCount, 16), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kind);
  if (buffer.mapped() != nullptr) {
    writeInParallel({buffer.mapped(), byteCount}, 0, itemByteCount, write);
    return buffer;
  }
  forEachPiece(device, byteCount, itemByteCount,
               [&](CommandList& commands, const Buffer& staging, uint64_t begin, uint64_t count) {
                 writeInParallel({staging.mapped(), count}, begin / itemByteCount, itemByteCount, write);
                 commands.begin();
                 commands.copy(staging, 0, buffer, begin, count);
                 commands.barrier();
                 commands.submitAndWait();
               });
  return buffer;
}

void downloadBuffer(const Device& device, const Buffer& buffer, std::span<std::byte> bytes) {
  if (buffer.mapped() != nullptr) {
    std::ranges::copy(std::span(buffer.mapped(), bytes.size()), bytes.begin());
    return;
  }
  forEachPiece(device, bytes.size(), 1,
               [&](CommandList& commands, const Buffer& staging, uint64_t begin, uint64_t count) {
                 commands.begin();
                 commands.copy(buffer, begin, staging, 0, count);
                 commands.barrier();
                 commands.submitAndWait();
                 writeInParallel(bytes.subspan(begin, count), 0, 1, [&](size_t first, std::span<std::byte> to) {
                   std::memcpy(to.data(), staging.mapped() + first, to.size());
                 });
               });
}

}  // namespace asdfvk
