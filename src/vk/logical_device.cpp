#include "vk/logical_device.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "vk/physical_device.h"
#include "vk/result.h"

namespace asdfvk {
namespace {

bool requiresSubgroupSizes(const DeviceFacts& device) { return device.maxRequiredSubgroupSize > 0; }

std::vector<const char*> extensionsFor(VkPhysicalDevice physical, const DeviceFacts& facts) {
  // A device that has this extension must be opened with it.
  constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";
  std::vector<const char*> names;
  if (offersExtension(physical, kPortabilitySubset)) names.push_back(kPortabilitySubset);
  // Drivers of Vulkan 1.3 offer this extension too, so that instances of Vulkan 1.2 suffice.
  if (requiresSubgroupSizes(facts)) names.push_back(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
  return names;
}

}  // namespace

LogicalDevice::LogicalDevice(VkPhysicalDevice physical, DeviceFacts facts, uint32_t maxQueueCount)
    : facts_(std::move(facts)) {
  vkGetPhysicalDeviceMemoryProperties(physical, &memoryTypes_);
  VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queueInfo.queueFamilyIndex = facts_.computeQueueFamily.value();
  queueInfo.queueCount = std::clamp(maxQueueCount, uint32_t{1}, facts_.computeQueueCount);
  const std::vector<float> priorities(queueInfo.queueCount, 1.0f);
  queueInfo.pQueuePriorities = priorities.data();
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queueInfo;
  VkPhysicalDeviceSubgroupSizeControlFeaturesEXT subgroupSizes{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES_EXT};
  subgroupSizes.subgroupSizeControl = VK_TRUE;
  if (requiresSubgroupSizes(facts_)) info.pNext = &subgroupSizes;
  const std::vector<const char*> extensions = extensionsFor(physical, facts_);
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDevice device = VK_NULL_HANDLE;
  requireSuccess(vkCreateDevice(physical, &info, nullptr, &device), "opening " + facts_.name);
  device_.reset(device);
  for (uint32_t i = 0; i < queueInfo.queueCount; ++i) {
    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(device, queueInfo.queueFamilyIndex, i, &queue);
    queues_.emplace_back(queue);
  }
}

VkResult LogicalDevice::Queue::submit(const VkSubmitInfo& info, VkFence fence) {
  const std::lock_guard lock(mutex_);
  return vkQueueSubmit(queue_, 1, &info, fence);
}

}  // namespace asdfvk
