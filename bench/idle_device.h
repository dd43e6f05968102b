#pragma once

#include <volk.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>

namespace asdfvk::bench {

/// During its lifetime, submissions end at once without running their commands. Mapped memory and the targets of copies
/// to buffers that are made meanwhile are filled with a length, so that values are valid, but not hits.
class IdleDevice {
 public:
  IdleDevice() {
    submit_ = vkQueueSubmit, allocate_ = vkAllocateMemory, map_ = vkMapMemory, bind_ = vkBindBufferMemory,
    destroy_ = vkDestroyBuffer, free_ = vkFreeMemory, copy_ = vkCmdCopyBuffer;
    vkQueueSubmit = [](VkQueue queue, uint32_t, const VkSubmitInfo*, VkFence fence) {
      return submit_(queue, 0, nullptr, fence);
    };
    vkAllocateMemory = [](VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                          VkDeviceMemory* memory) {
      byteCount_ = info->allocationSize;
      return allocate_(device, info, callbacks, memory);
    };
    vkMapMemory = [](VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                     VkMemoryMapFlags flags, void** data) {
      const VkResult result = map_(device, memory, offset, size, flags, data);
      if (result != VK_SUCCESS) return result;
      fill(*data, byteCount_);
      const std::lock_guard lock(mutex_);
      mapped_[memory] = static_cast<std::byte*>(*data);
      return result;
    };
    vkBindBufferMemory = [](VkDevice device, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset) {
      const std::lock_guard lock(mutex_);
      if (const auto found = mapped_.find(memory); found != mapped_.end()) buffers_[buffer] = found->second + offset;
      return bind_(device, buffer, memory, offset);
    };
    vkDestroyBuffer = [](VkDevice device, VkBuffer buffer, const VkAllocationCallbacks* callbacks) {
      {
        const std::lock_guard lock(mutex_);
        buffers_.erase(buffer);
      }
      destroy_(device, buffer, callbacks);
    };
    vkFreeMemory = [](VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
      {
        const std::lock_guard lock(mutex_);
        mapped_.erase(memory);
      }
      free_(device, memory, callbacks);
    };
    vkCmdCopyBuffer = [](VkCommandBuffer commands, VkBuffer from, VkBuffer to, uint32_t count,
                         const VkBufferCopy* regions) {
      if (std::byte* const target = mappedOf(to))
        for (uint32_t i = 0; i < count; ++i) fill(target + regions[i].dstOffset, regions[i].size);
      copy_(commands, from, to, count, regions);
    };
  }
  ~IdleDevice() {
    vkQueueSubmit = submit_, vkAllocateMemory = allocate_, vkMapMemory = map_, vkBindBufferMemory = bind_,
    vkDestroyBuffer = destroy_, vkFreeMemory = free_, vkCmdCopyBuffer = copy_;
    mapped_.clear();
    buffers_.clear();
  }
  IdleDevice(const IdleDevice&) = delete;
  IdleDevice& operator=(const IdleDevice&) = delete;

 private:
  static void fill(void* bytes, uint64_t byteCount) {
    std::fill_n(static_cast<float*>(bytes), byteCount / sizeof(float), 0.25f);
  }
  [[nodiscard]] static std::byte* mappedOf(VkBuffer buffer) {
    const std::lock_guard lock(mutex_);
    const auto found = buffers_.find(buffer);
    return found == buffers_.end() ? nullptr : found->second;
  }

  static inline PFN_vkQueueSubmit submit_ = nullptr;
  static inline PFN_vkAllocateMemory allocate_ = nullptr;
  static inline PFN_vkMapMemory map_ = nullptr;
  static inline PFN_vkBindBufferMemory bind_ = nullptr;
  static inline PFN_vkDestroyBuffer destroy_ = nullptr;
  static inline PFN_vkFreeMemory free_ = nullptr;
  static inline PFN_vkCmdCopyBuffer copy_ = nullptr;
  static inline thread_local uint64_t byteCount_ = 0;  // Size of the last allocation of the thread, in bytes.
  static inline std::mutex mutex_;
  static inline std::map<VkDeviceMemory, std::byte*> mapped_;
  static inline std::map<VkBuffer, std::byte*> buffers_;
};

}  // namespace asdfvk::bench
