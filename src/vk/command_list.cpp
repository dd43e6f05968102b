#include "vk/command_list.h"

#include <array>

#include "vk/result.h"

namespace asdfvk {

CommandList::CommandList(const Device& device) : device_(device), objects_(device.commandPool().take()) {}

CommandList::~CommandList() {
  finish();
  device_.commandPool().give(objects_);
}

void CommandList::begin() {
  wait();
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  requireSuccess(vkBeginCommandBuffer(objects_.commands, &info), "beginning a command buffer");
  spans_.clear();
  if (objects_.timestamps != VK_NULL_HANDLE)
    vkCmdResetQueryPool(objects_.commands, objects_.timestamps, 0, SubmissionObjects::kMaxTimestampCount);
}

/// The stage "bottom of pipe" is reached when all earlier commands have ended, also those of earlier submissions.
/// Therefore the time between two timestamps has no other work.
void CommandList::enter(Work work) {
  if (objects_.timestamps == VK_NULL_HANDLE || (!spans_.empty() && spans_.back() == work) ||
      spans_.size() + 1 == SubmissionObjects::kMaxTimestampCount)
    return;
  vkCmdWriteTimestamp(objects_.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, objects_.timestamps,
                      static_cast<uint32_t>(spans_.size()));
  spans_.push_back(work);
}

void CommandList::addSeconds() const {
  if (spans_.empty()) return;
  std::array<uint64_t, SubmissionObjects::kMaxTimestampCount> times{};
  const auto count = static_cast<uint32_t>(spans_.size() + 1);
  if (vkGetQueryPoolResults(device_.handle(), objects_.timestamps, 0, count, count * sizeof(uint64_t), times.data(),
                            sizeof(uint64_t), VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
    return;
  const DeviceFacts& facts = device_.facts();
  const uint64_t validBits = facts.timestampBits < 64 ? (uint64_t{1} << facts.timestampBits) - 1 : ~uint64_t{0};
  DeviceSeconds seconds;
  for (size_t i = 0; i < spans_.size(); ++i)
    (spans_[i] == Work::Kernel ? seconds.kernels : seconds.copies) +=
        static_cast<double>((times[i + 1] - times[i]) & validBits) * facts.secondsPerTimestamp;
  device_.addSeconds(seconds);
}

void CommandList::bind(const ComputePipeline& pipeline, const BindingSet& bindings,
                       std::span<const std::byte> pushConstants) {
  enter(Work::Kernel);
  const VkDescriptorSet set = bindings.handle();
  vkCmdBindPipeline(objects_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
  vkCmdBindDescriptorSets(objects_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), 0, 1, &set, 0, nullptr);
  if (!pushConstants.empty())
    vkCmdPushConstants(objects_.commands, pipeline.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<uint32_t>(pushConstants.size()), pushConstants.data());
}

void CommandList::dispatch(const ComputePipeline& pipeline, const BindingSet& bindings,
                           std::span<const std::byte> pushConstants, uint32_t workgroupCount,
                           uint32_t workgroupCountY) {
  bind(pipeline, bindings, pushConstants);
  vkCmdDispatch(objects_.commands, workgroupCount, workgroupCountY, 1);
}

void CommandList::dispatchIndirect(const ComputePipeline& pipeline, const BindingSet& bindings,
                                   std::span<const std::byte> pushConstants, const Buffer& size) {
  bind(pipeline, bindings, pushConstants);
  vkCmdDispatchIndirect(objects_.commands, size.handle(), 0);
}

void CommandList::fillWithZeros(const Buffer& buffer) {
  enter(Work::Copy);
  vkCmdFillBuffer(objects_.commands, buffer.handle(), 0, VK_WHOLE_SIZE, 0);
}

void CommandList::copy(const Buffer& from, uint64_t fromOffset, const Buffer& to, uint64_t toOffset,
                       uint64_t byteCount) {
  enter(Work::Copy);
  const VkBufferCopy region{fromOffset, toOffset, byteCount};
  vkCmdCopyBuffer(objects_.commands, from.handle(), to.handle(), 1, &region);
}

void CommandList::barrier() {
  VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                         VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_HOST_READ_BIT;
  const VkPipelineStageFlags work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  const VkPipelineStageFlags readers = work | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_HOST_BIT;
  vkCmdPipelineBarrier(objects_.commands, work, readers, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void CommandList::submit() {
  if (!spans_.empty())
    vkCmdWriteTimestamp(objects_.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, objects_.timestamps,
                        static_cast<uint32_t>(spans_.size()));
  requireSuccess(vkEndCommandBuffer(objects_.commands), "ending a command buffer");
  VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  info.commandBufferCount = 1;
  info.pCommandBuffers = &objects_.commands;
  device_.submit(info, objects_.fence);
  isPending_ = true;
}

bool CommandList::hasEnded() const {
  return !isPending_ || vkGetFenceStatus(device_.handle(), objects_.fence) == VK_SUCCESS;
}

void CommandList::wait() {
  if (!isPending_) return;
  const VkResult result =
      hasEnded() ? VK_SUCCESS : vkWaitForFences(device_.handle(), 1, &objects_.fence, VK_TRUE, UINT64_MAX);
  isPending_ = result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST;
  device_.requireWaited(result);
  requireSuccess(vkResetFences(device_.handle(), 1, &objects_.fence), "resetting a fence");
  addSeconds();
}

void CommandList::finish() noexcept {
  if (!isPending_) return;
  if (hasEnded() || vkWaitForFences(device_.handle(), 1, &objects_.fence, VK_TRUE, UINT64_MAX) == VK_SUCCESS)
    addSeconds();
  isPending_ = false;
  (void)vkResetFences(device_.handle(), 1, &objects_.fence);
}

}  // namespace asdfvk
