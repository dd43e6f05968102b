#include "vk/command_pool.h"

#include "vk/result.h"

namespace asdfvk {

CommandPool::CommandPool(VkDevice device, const DeviceFacts& facts)
    : device_(device), hasTimestamps_(facts.timestampBits > 0) {
  VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  info.queueFamilyIndex = facts.computeQueueFamily.value();
  requireSuccess(vkCreateCommandPool(device_, &info, nullptr, &pool_), "creating a command pool");
  try {
    idle_.reserve(kFirstCount);
    while (idle_.size() < kFirstCount) idle_.push_back(make());
  } catch (...) {
    destroyAll();
    throw;
  }
}

CommandPool::~CommandPool() { destroyAll(); }

void CommandPool::destroyAll() noexcept {
  for (const SubmissionObjects& objects : idle_) destroy(objects);
  vkDestroyCommandPool(device_, pool_, nullptr);
}

SubmissionObjects CommandPool::take() {
  if (idle_.empty()) return make();
  const SubmissionObjects objects = idle_.back();
  idle_.pop_back();
  return objects;
}

SubmissionObjects CommandPool::make() {
  SubmissionObjects objects;
  try {
    VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocation.commandPool = pool_;
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    requireSuccess(vkAllocateCommandBuffers(device_, &allocation, &objects.commands), "allocating a command buffer");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
    requireSuccess(vkCreateFence(device_, &fence, nullptr, &objects.fence), "creating a fence");
    if (!hasTimestamps_) return objects;
    VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = SubmissionObjects::kMaxTimestampCount;
    requireSuccess(vkCreateQueryPool(device_, &queries, nullptr, &objects.timestamps), "creating a query pool");
    return objects;
  } catch (...) {
    destroy(objects);
    throw;
  }
}

void CommandPool::give(const SubmissionObjects& objects) noexcept {
  try {
    idle_.push_back(objects);
  } catch (...) {  // The host has no memory for the entry.
    destroy(objects);
  }
}

void CommandPool::destroy(const SubmissionObjects& objects) noexcept {
  vkDestroyQueryPool(device_, objects.timestamps, nullptr);
  vkDestroyFence(device_, objects.fence, nullptr);
  if (objects.commands != VK_NULL_HANDLE) vkFreeCommandBuffers(device_, pool_, 1, &objects.commands);
}

}  // namespace asdfvk
