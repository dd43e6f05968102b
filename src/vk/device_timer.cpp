#include "vk/device_timer.h"

#include <algorithm>
#include <array>

namespace asdfvk {

void BusyTicks::add(uint64_t begin, uint64_t end) {
  begin &= mask_;
  end &= mask_;
  const uint64_t from = lastEnd_ && isOrdered(begin, *lastEnd_) ? *lastEnd_ : begin;
  if (!isOrdered(from, end)) return;
  total_ += (end - from) & mask_;
  lastEnd_ = end;
}

DeviceTimer::DeviceTimer(const Device& device, uint32_t slotCount)
    : device_(device.handle()),
      secondsPerTick_(device.facts().timestampPeriod * 1e-9),
      ticks_(std::max(1u, device.facts().timestampValidBits)) {
  if (device.facts().timestampValidBits == 0) return;
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2 * slotCount;
  if (vkCreateQueryPool(device_, &info, nullptr, &pool_) != VK_SUCCESS) pool_ = VK_NULL_HANDLE;
}

DeviceTimer::~DeviceTimer() { vkDestroyQueryPool(device_, pool_, nullptr); }

void DeviceTimer::begin(VkCommandBuffer commands, uint32_t slot) {
  if (!pool_) return;
  vkCmdResetQueryPool(commands, pool_, 2 * slot, 2);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool_, 2 * slot);
}

void DeviceTimer::end(VkCommandBuffer commands, uint32_t slot) {
  if (pool_) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_, 2 * slot + 1);
}

void DeviceTimer::add(uint32_t slot) {
  if (!pool_) return;
  std::array<uint64_t, 2> times{};
  const VkResult result = vkGetQueryPoolResults(device_, pool_, 2 * slot, 2, sizeof(times), times.data(),
                                                sizeof(times[0]), VK_QUERY_RESULT_64_BIT);
  if (result == VK_SUCCESS) ticks_.add(times[0], times[1]);
}

std::optional<double> DeviceTimer::seconds() const {
  if (!pool_) return std::nullopt;
  return static_cast<double>(ticks_.total()) * secondsPerTick_;
}

}  // namespace asdfvk
