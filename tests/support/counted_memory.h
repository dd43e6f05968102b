#pragma once

#include <volk.h>

#include <cstdint>

namespace asdfvk::test {

/// Counts the device memory that is allocated while it exists, without what is freed.
class CountedMemory {
 public:
  CountedMemory() : allocate_(vkAllocateMemory) {
    original = allocate_;
    byteCount_ = allocationCount_ = 0;
    vkAllocateMemory = [](VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                          VkDeviceMemory* memory) -> VkResult {
      byteCount_ += info->allocationSize;
      ++allocationCount_;
      return original(device, info, callbacks, memory);
    };
  }
  ~CountedMemory() { vkAllocateMemory = allocate_; }
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  [[nodiscard]] uint64_t byteCount() const { return byteCount_; }
  [[nodiscard]] uint64_t allocationCount() const { return allocationCount_; }

 private:
  static inline PFN_vkAllocateMemory original = nullptr;
  static inline uint64_t byteCount_ = 0, allocationCount_ = 0;
  PFN_vkAllocateMemory allocate_;
};

}  // namespace asdfvk::test
