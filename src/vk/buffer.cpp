#include "vk/buffer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/parallel.h"
#include "vk/command_list.h"
#include "vk/result.h"
#include "vk/upload_queue.h"

namespace asdfvk {
namespace {

MemoryKind kindOn(const Device& device, MemoryKind kind) {
  return kind != MemoryKind::HostVisible && !device.facts().mapsDeviceMemory ? MemoryKind::DeviceOnly : kind;
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

/// Calls visit(begin, byteCount) for pieces of whole items.
template <typename Visit>
void forEachPiece(uint64_t byteCount, size_t itemByteCount, const Visit& visit) {
  const uint64_t pieceByteCount = kMaxPieceByteCount / itemByteCount * itemByteCount;
  for (uint64_t begin = 0; begin < byteCount; begin += pieceByteCount)
    visit(begin, std::min(pieceByteCount, byteCount - begin));
}

}  // namespace

Buffer::Buffer(const Device& device, uint64_t byteCount, VkBufferUsageFlags usage, MemoryKind kind)
    : device_(&device), byteCount_(byteCount) {
  const uint64_t limit = device.facts().maxMemoryAllocationSize;
  if (limit > 0 && byteCount > limit)
    throw Error(ErrorCode::DeviceLimit, fmt::format("{} allows {} MiB in one buffer and the mesh needs {}",
                                                    device.facts().name, limit >> 20, (byteCount >> 20) + 1));
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = byteCount;
  info.usage = usage;
  requireSuccess(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "creating a buffer");
  Buffer guard = std::move(*this);  // If a later step throws, the guard frees the members that exist by then.

  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.handle(), guard.buffer_, &requirements);
  const std::vector<uint32_t> types =
      rankMemoryTypes(device.memoryTypes(), requirements.memoryTypeBits, kindOn(device, kind), byteCount);
  if (types.empty())
    throw Error(ErrorCode::DeviceLimit, fmt::format("{} has no memory type for this buffer", device.facts().name));
  MemoryArena::Range range;
  requireSuccess(device.memory().take(requirements, types, range),
                 fmt::format("allocating {} MiB on {}", (byteCount >> 20) + 1, device.facts().name));
  guard.memory_ = range;
  requireSuccess(vkBindBufferMemory(device.handle(), guard.buffer_, range.block->memory, range.offset),
                 "binding memory");
  if (kindOn(device, kind) != MemoryKind::DeviceOnly && range.block->mapped != nullptr) {
    guard.mapped_ = range.block->mapped + range.offset;
    guard.isCached_ = (device.memoryFlags(range.block->type) & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
  }
  *this = std::move(guard);
}

Buffer::~Buffer() {
  if (buffer_ == VK_NULL_HANDLE) return;
  device_->uploads().finish(buffer_);
  vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  if (memory_.block != nullptr) device_->memory().give(memory_);
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
  forEachPiece(byteCount, itemByteCount, [&](uint64_t begin, uint64_t count) {
    device.uploads().add(buffer, begin, count, [&](std::span<std::byte> staging) {
      writeInParallel(staging, begin / itemByteCount, itemByteCount, write);
    });
  });
  return buffer;
}

void downloadBuffer(const Device& device, const Buffer& buffer, std::span<std::byte> bytes) {
  if (buffer.isCached()) {
    CommandList wait(device);
    wait.begin();
    wait.barrier();
    wait.submitAndWait();
    std::ranges::copy(std::span(buffer.mapped(), bytes.size()), bytes.begin());
    return;
  }
  if (bytes.empty()) return;
  const Buffer staging(device, std::min<uint64_t>(bytes.size(), kMaxPieceByteCount), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       MemoryKind::HostVisible);
  CommandList commands(device);
  forEachPiece(bytes.size(), 1, [&](uint64_t begin, uint64_t count) {
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
