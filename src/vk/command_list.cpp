#include "vk/command_list.h"

#include "vk/result.h"

namespace asdfvk {

CommandList::CommandList(const Device& device) : device_(device) {
  VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocation.commandPool = device.commandPool();
  allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocation.commandBufferCount = 1;
  requireSuccess(vkAllocateCommandBuffers(device.handle(), &allocation, &commands_), "allocating a command buffer");
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
  if (const VkResult result = vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence_); result != VK_SUCCESS) {
    vkFreeCommandBuffers(device.handle(), device.commandPool(), 1, &commands_);
    requireSuccess(result, "creating a fence");
  }
}

CommandList::~CommandList() {
  finish();
  vkDestroyFence(device_.handle(), fence_, nullptr);
  vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &commands_);
}

void CommandList::begin() {
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  requireSuccess(vkBeginCommandBuffer(commands_, &info), "beginning a command buffer");
}

void CommandList::bind(const ComputePipeline& pipeline, const BindingSet& bindings,
                       std::span<const std::byte> pushConstants) {
  const VkDescriptorSet set = bindings.handle();
  vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
  vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), 0, 1, &set, 0, nullptr);
  if (!pushConstants.empty())
    vkCmdPushConstants(commands_, pipeline.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<uint32_t>(pushConstants.size()), pushConstants.data());
}

void CommandList::dispatch(const ComputePipeline& pipeline, const BindingSet& bindings,
                           std::span<const std::byte> pushConstants, uint32_t workgroupCount,
                           uint32_t workgroupCountY) {
  bind(pipeline, bindings, pushConstants);
  vkCmdDispatch(commands_, workgroupCount, workgroupCountY, 1);
}

void CommandList::dispatchIndirect(const ComputePipeline& pipeline, const BindingSet& bindings,
                                   std::span<const std::byte> pushConstants, const Buffer& size) {
  bind(pipeline, bindings, pushConstants);
  vkCmdDispatchIndirect(commands_, size.handle(), 0);
}

void CommandList::fillWithZeros(const Buffer& buffer) {
  vkCmdFillBuffer(commands_, buffer.handle(), 0, VK_WHOLE_SIZE, 0);
}

void CommandList::copy(const Buffer& from, uint64_t fromOffset, const Buffer& to, uint64_t toOffset,
                       uint64_t byteCount) {
  const VkBufferCopy region{fromOffset, toOffset, byteCount};
  vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &region);
}

void CommandList::barrier() {
  VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                         VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_HOST_READ_BIT;
  const VkPipelineStageFlags work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  const VkPipelineStageFlags readers = work | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_HOST_BIT;
  vkCmdPipelineBarrier(commands_, work, readers, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void CommandList::submit() {
  requireSuccess(vkEndCommandBuffer(commands_), "ending a command buffer");
  VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands_;
  requireSuccess(vkQueueSubmit(device_.queue(), 1, &info, fence_), "submitting work to " + device_.facts().name);
  isPending_ = true;
}

void CommandList::wait() {
  if (!isPending_) return;
  const VkResult result = vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
  isPending_ = result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST;
  requireSuccess(result, "waiting for " + device_.facts().name);
  requireSuccess(vkResetFences(device_.handle(), 1, &fence_), "resetting a fence");
}

void CommandList::finish() noexcept {
  if (!isPending_) return;
  isPending_ = false;
  (void)vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
  (void)vkResetFences(device_.handle(), 1, &fence_);
}

}  // namespace asdfvk
