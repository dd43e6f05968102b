#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace asdfvk {

class Device;

/// Memory of buffers, in blocks that later buffers use again, because a GPU driver takes up to milliseconds to allocate
/// memory.
class MemoryArena {
 public:
  /// Greatest memory of blocks without a used range, on GPUs and on CPU devices. Further blocks are freed.
  static constexpr uint64_t kMaxIdleByteCount = 512u << 20, kMaxIdleByteCountOnCpu = 16u << 20;

  /// The device must outlive the arena.
  explicit MemoryArena(const Device& device) : device_(device) {}

  struct Block {
    Block(const Device& device, uint64_t byteCount, uint32_t type);
    ~Block();
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
    [[nodiscard]] bool isIdle() const { return free.size() == 1 && free.begin()->second == byteCount; }

    VkDevice device;
    uint64_t byteCount;
    uint32_t type;
    VkResult allocated;  ///< If it is not VK_SUCCESS, the block has no memory.
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;             ///< Null if the host cannot access the memory.
    std::map<uint64_t, uint64_t> free = {};  ///< Byte counts of the free ranges by their offsets.
  };
  struct Range {
    Block* block = nullptr;
    uint64_t offset = 0, byteCount = 0;
  };

  /// Takes memory of the first of these types that has enough left. Returns the result of the last allocation. range:
  /// set if the result is VK_SUCCESS.
  [[nodiscard]] VkResult take(const VkMemoryRequirements& needed, std::span<const uint32_t> types, Range& range);
  /// Precondition: no submitted work uses the memory.
  void give(const Range& range) noexcept;

  /// Memory of the blocks without a used range.
  [[nodiscard]] uint64_t idleByteCount() const;
  /// Frees these blocks.
  void clear();

 private:
  [[nodiscard]] bool takeFrom(Block& block, const VkMemoryRequirements& needed, Range& range);
  [[nodiscard]] VkResult addBlock(uint64_t needed, uint32_t type);
  [[nodiscard]] VkResult takeOfType(const VkMemoryRequirements& needed, uint32_t type, Range& range);

  const Device& device_;
  std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace asdfvk
