#include "vk/device.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "vk/result.h"
#include "vk/upload_queue.h"

namespace asdfvk {

OpenedLogicalDevice openLogicalDevice(const Instance& instance, const DeviceRequest& request, uint32_t maxQueueCount) {
  const std::vector<VkPhysicalDevice> physical = instance.physicalDevices();
  if (physical.empty()) throw Error(ErrorCode::NoVulkanDriver, "no Vulkan device was found");
  const std::vector<DeviceFacts> facts = describeDevices(physical);
  const DeviceChoice choice = chooseDevice(facts, request);
  std::vector<std::string> reasons;
  for (size_t i = 0; i < facts.size(); ++i)
    reasons.push_back(fmt::format("{} ({}): {}", facts[i].name, toString(facts[i].kind), choice.reasons[i]));
  if (!choice.index)
    throw Error(request.requireGpu ? ErrorCode::GpuRequired : ErrorCode::NoUsableDevice,
                fmt::format("no usable Vulkan device: {}", joined(reasons, ", ")));
  const auto chosen = reasons.begin() + *choice.index;
  *chosen += fmt::format(", driver {}", facts[*choice.index].driver);
  std::rotate(reasons.begin(), chosen, chosen + 1);
  return {std::make_shared<LogicalDevice>(physical[*choice.index], facts[*choice.index], maxQueueCount),
          std::move(reasons)};
}

OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request) {
  OpenedLogicalDevice opened = openLogicalDevice(instance, request);
  return {std::make_unique<Device>(std::move(opened.device)), std::move(opened.reasons)};
}

Device::Device(std::shared_ptr<LogicalDevice> logical)
    : logical_(std::move(logical)),
      queue_(logical_->nextQueue()),
      memory_(std::make_unique<MemoryArena>(*this)),
      descriptorSets_(std::make_unique<DescriptorSets>(handle())),
      commandPool_(std::make_unique<CommandPool>(handle(), facts())),
      uploads_(std::make_unique<UploadQueue>(*this)) {}

Device::Device(VkPhysicalDevice physical, DeviceFacts facts)
    : Device(std::make_shared<LogicalDevice>(physical, std::move(facts))) {}

Device::~Device() { uploads_->finishAll(); }

void Device::submit(const VkSubmitInfo& info, VkFence fence) const {
  const VkResult result = queue_.submit(info, fence);
  logical_->note(result);
  requireSuccess(result, "submitting work to " + facts().name);
}

void Device::requireWaited(VkResult result) const {
  logical_->note(result);
  requireSuccess(result, "waiting for " + facts().name);
}

}  // namespace asdfvk
