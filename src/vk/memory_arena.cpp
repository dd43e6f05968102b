#include "vk/memory_arena.h"

#include <algorithm>
#include <iterator>

#include "core/huge_pages.h"
#include "vk/device.h"
#include "vk/upload_queue.h"

namespace asdfvk {
namespace {

constexpr uint64_t kMinBlockByteCount = 8u << 20, kMinBlockByteCountOnCpu = 1u << 20;
constexpr uint64_t kMaxBlockByteCount = 256u << 20;  // A larger block has a buffer of at least half of its size.
constexpr uint64_t kMinAlignment = 256;

uint64_t roundUpTo(uint64_t alignment, uint64_t value) { return (value + alignment - 1) / alignment * alignment; }

}  // namespace

MemoryArena::Block::Block(const Device& on, uint64_t count, uint32_t memoryType)
    : device(on.handle()), byteCount(count), type(memoryType) {
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = byteCount;
  info.memoryTypeIndex = type;
  allocated = vkAllocateMemory(device, &info, nullptr, &memory);
  if (allocated != VK_SUCCESS) return;
  free.emplace(0, byteCount);
  if ((on.memoryFlags(type) & kMappableMemory) != kMappableMemory) return;
  void* pointer = nullptr;
  allocated = vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &pointer);
  mapped = static_cast<std::byte*>(pointer);
  // A CPU device uses memory of the process, which its driver allocates in small pages.
  if (allocated == VK_SUCCESS && on.facts().isCpu()) requestHugePages(pointer, byteCount);
}

MemoryArena::Block::~Block() { vkFreeMemory(device, memory, nullptr); }

uint64_t MemoryArena::idleByteCount() const {
  uint64_t count = 0;
  for (const std::unique_ptr<Block>& block : blocks_) count += block->isIdle() ? block->byteCount : 0;
  return count;
}

void MemoryArena::clear() {
  std::erase_if(blocks_, [](const std::unique_ptr<Block>& block) { return block->isIdle(); });
}

VkResult MemoryArena::take(const VkMemoryRequirements& needed, std::span<const uint32_t> types, Range& range) {
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (const bool isLastAttempt : {false, true}) {
    for (const uint32_t type : types) {
      result = takeOfType(needed, type, range);
      if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY) return result;
    }
    device_.uploads().releaseEnded();
    if (isLastAttempt || idleByteCount() == 0) break;
    clear();
  }
  return result;
}

VkResult MemoryArena::takeOfType(const VkMemoryRequirements& needed, uint32_t type, Range& range) {
  for (const std::unique_ptr<Block>& block : blocks_) {
    const bool isTooLarge = block->byteCount > kMaxBlockByteCount && block->byteCount / 2 > needed.size;
    if (block->type == type && !isTooLarge && takeFrom(*block, needed, range)) return VK_SUCCESS;
  }
  const VkResult result = addBlock(roundUpTo(kMinAlignment, needed.size), type);
  if (result == VK_SUCCESS) (void)takeFrom(*blocks_.back(), needed, range);
  return result;
}

/// Blocks grow with the memory of their type, so that few are allocated. On a CPU device, where allocations are fast
/// and the memory is that of the process, a block has no more than what is needed, but at least 1 MiB.
VkResult MemoryArena::addBlock(uint64_t needed, uint32_t type) {
  uint64_t count = kMinBlockByteCountOnCpu;
  if (!device_.facts().isCpu()) {
    uint64_t ofType = kMinBlockByteCount;
    for (const std::unique_ptr<Block>& block : blocks_) ofType += block->type == type ? block->byteCount : 0;
    count = std::min(ofType, kMaxBlockByteCount);
  }
  if (const uint64_t limit = device_.facts().maxMemoryAllocationSize; limit > 0) count = std::min(count, limit);
  count = std::max(count, needed);
  auto block = std::make_unique<Block>(device_, count, type);
  if (block->allocated == VK_ERROR_OUT_OF_DEVICE_MEMORY && count > needed)
    block = std::make_unique<Block>(device_, needed, type);
  const VkResult result = block->allocated;
  if (result == VK_SUCCESS) blocks_.push_back(std::move(block));
  return result;
}

bool MemoryArena::takeFrom(Block& block, const VkMemoryRequirements& needed, Range& range) {
  const uint64_t alignment = std::max(kMinAlignment, needed.alignment), count = roundUpTo(kMinAlignment, needed.size);
  for (auto free = block.free.begin(); free != block.free.end(); ++free) {
    const auto [begin, freeCount] = *free;
    const uint64_t offset = roundUpTo(alignment, begin), end = begin + freeCount;
    if (offset + count > end) continue;
    block.free.erase(free);
    if (offset > begin) block.free.emplace(begin, offset - begin);
    if (end > offset + count) block.free.emplace(offset + count, end - offset - count);
    range = {&block, offset, count};
    return true;
  }
  return false;
}

void MemoryArena::give(const Range& range) noexcept {
  std::map<uint64_t, uint64_t>& free = range.block->free;
  auto given = free.end();
  try {
    given = free.emplace(range.offset, range.byteCount).first;
  } catch (...) {  // The host has no memory for the entry. The range stays used.
    return;
  }
  if (const auto next = std::next(given); next != free.end() && given->first + given->second == next->first) {
    given->second += next->second;
    free.erase(next);
  }
  if (given != free.begin())
    if (const auto last = std::prev(given); last->first + last->second == given->first) {
      last->second += given->second;
      free.erase(given);
    }
  const uint64_t maxIdle = device_.facts().isCpu() ? kMaxIdleByteCountOnCpu : kMaxIdleByteCount;
  if (range.block->isIdle() && idleByteCount() > maxIdle)
    std::erase_if(blocks_, [&](const std::unique_ptr<Block>& block) { return block.get() == range.block; });
}

}  // namespace asdfvk
