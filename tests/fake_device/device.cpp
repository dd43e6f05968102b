// Memory and submissions of a device: separate and poisoned memory, and the failures that the environment requests.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include "state.h"

namespace asdfvk::fake {
namespace {

void restrictTypes(const DeviceState& device, VkMemoryRequirements& requirements) {
  if (!device.settings.hasSeparateMemory) return;
  const bool isAllowed = (requirements.memoryTypeBits & (1u << device.driverMemoryType)) != 0;
  requirements.memoryTypeBits = isAllowed ? (1u << separateTypeCount(device.settings)) - 1 : 0;
}

VKAPI_ATTR void VKAPI_CALL getBufferRequirements(VkDevice handle, VkBuffer buffer, VkMemoryRequirements* requirements) {
  const DeviceState& device = devices().of(handle);
  device.next<PFN_vkGetBufferMemoryRequirements>("vkGetBufferMemoryRequirements")(handle, buffer, requirements);
  restrictTypes(device, *requirements);
}

VKAPI_ATTR void VKAPI_CALL getBufferRequirements2(VkDevice handle, const VkBufferMemoryRequirementsInfo2* info,
                                                  VkMemoryRequirements2* requirements) {
  const DeviceState& device = devices().of(handle);
  device.next<PFN_vkGetBufferMemoryRequirements2>("vkGetBufferMemoryRequirements2")(handle, info, requirements);
  restrictTypes(device, requirements->memoryRequirements);
}

void fill(const DeviceState& device, VkDeviceMemory memory, VkDeviceSize byteCount, uint32_t word) {
  void* bytes = nullptr;
  if (device.next<PFN_vkMapMemory>("vkMapMemory")(device.handle, memory, 0, VK_WHOLE_SIZE, 0, &bytes) != VK_SUCCESS)
    return;
  std::fill_n(static_cast<uint32_t*>(bytes), byteCount / sizeof word, word);
  device.next<PFN_vkUnmapMemory>("vkUnmapMemory")(device.handle, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice handle, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
  DeviceState& device = devices().of(handle);
  if (lacksMemoryAt(++device.allocationCount)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  VkMemoryAllocateInfo changed = *info;
  if (device.settings.hasSeparateMemory) changed.memoryTypeIndex = device.driverMemoryType;
  const VkResult result = device.next<PFN_vkAllocateMemory>("vkAllocateMemory")(handle, &changed, allocator, memory);
  if (result != VK_SUCCESS) return result;
  if (device.settings.poison) fill(device, *memory, changed.allocationSize, *device.settings.poison);
  if (device.settings.hasSeparateMemory && info->memoryTypeIndex == kLocalType) {
    const std::lock_guard lock(device.mutex);
    device.unmappable.insert(*memory);
  }
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL release(VkDevice handle, VkDeviceMemory memory, const VkAllocationCallbacks* allocator) {
  DeviceState& device = devices().of(handle);
  {
    const std::lock_guard lock(device.mutex);
    device.unmappable.erase(memory);
  }
  device.next<PFN_vkFreeMemory>("vkFreeMemory")(handle, memory, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice handle, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize byteCount,
                                   VkMemoryMapFlags flags, void** bytes) {
  DeviceState& device = devices().of(handle);
  {
    const std::lock_guard lock(device.mutex);
    if (device.unmappable.count(memory) > 0) return VK_ERROR_MEMORY_MAP_FAILED;
  }
  return device.next<PFN_vkMapMemory>("vkMapMemory")(handle, memory, offset, byteCount, flags, bytes);
}

VKAPI_ATTR void VKAPI_CALL getQueue(VkDevice handle, uint32_t family, uint32_t index, VkQueue* queue) {
  const DeviceState& device = devices().of(handle);
  const auto get = device.next<PFN_vkGetDeviceQueue>("vkGetDeviceQueue");
  get(handle, family, device.settings.queueCount ? 0 : index, queue);
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
  DeviceState& device = devices().of(queue);
  const std::lock_guard lock(device.queueMutex);
  if (losesDeviceAt(++device.submissionCount) && !device.isLost.exchange(true)) {
    // What was submitted before may still use memory that the program frees now.
    (void)device.next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device.handle);
  }
  if (device.isLost) return VK_ERROR_DEVICE_LOST;
  return device.next<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

/// The result that a lost device has instead of `result`.
VkResult unlessLost(const DeviceState& device, VkResult result) {
  return device.isLost ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice handle, uint32_t count, const VkFence* fences,
                                             VkBool32 waitsForAll, uint64_t nanoseconds) {
  const DeviceState& device = devices().of(handle);
  if (device.isLost) return VK_ERROR_DEVICE_LOST;
  const auto wait = device.next<PFN_vkWaitForFences>("vkWaitForFences");
  return unlessLost(device, wait(handle, count, fences, waitsForAll, nanoseconds));
}

VKAPI_ATTR VkResult VKAPI_CALL getFenceStatus(VkDevice handle, VkFence fence) {
  const DeviceState& device = devices().of(handle);
  return unlessLost(device, device.next<PFN_vkGetFenceStatus>("vkGetFenceStatus")(handle, fence));
}

VKAPI_ATTR VkResult VKAPI_CALL waitForSemaphores(VkDevice handle, const VkSemaphoreWaitInfo* info,
                                                 uint64_t nanoseconds) {
  const DeviceState& device = devices().of(handle);
  if (device.isLost) return VK_ERROR_DEVICE_LOST;
  return unlessLost(device, device.next<PFN_vkWaitSemaphores>("vkWaitSemaphores")(handle, info, nanoseconds));
}

VKAPI_ATTR VkResult VKAPI_CALL waitForQueue(VkQueue queue) {
  const DeviceState& device = devices().of(queue);
  return unlessLost(device, device.next<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(queue));
}

VKAPI_ATTR VkResult VKAPI_CALL waitForDevice(VkDevice handle) {
  const DeviceState& device = devices().of(handle);
  return unlessLost(device, device.next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(handle));
}

/// With fake subgroup sizes, checks required sizes and hides them from the driver.
VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice handle, VkPipelineCache cache, uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  const DeviceState& device = devices().of(handle);
  std::this_thread::sleep_for(std::chrono::milliseconds(count * device.settings.pipelineMilliseconds));
  std::vector<VkComputePipelineCreateInfo> changed(infos, infos + count);
  for (VkComputePipelineCreateInfo& info : changed) {
    const auto* size = findStructure<VkPipelineShaderStageRequiredSubgroupSizeCreateInfoEXT>(
        info.stage.pNext, VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO_EXT);
    if (size == nullptr || !device.settings.maxSubgroupSize) continue;
    const bool isInRange = size->requiredSubgroupSize >= device.settings.minSubgroupSize.value_or(1) &&
                           size->requiredSubgroupSize <= *device.settings.maxSubgroupSize;
    if (!device.canRequireSubgroupSize || !isInRange) return VK_ERROR_FEATURE_NOT_PRESENT;
    info.stage.pNext = size->pNext;
  }
  const auto create = device.next<PFN_vkCreateComputePipelines>("vkCreateComputePipelines");
  return create(handle, cache, count, changed.data(), allocator, pipelines);
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice handle, const VkAllocationCallbacks* allocator) {
  if (handle == VK_NULL_HANDLE) return;
  const std::unique_ptr<DeviceState> device = devices().take(handle);
  device->next<PFN_vkDestroyDevice>("vkDestroyDevice")(handle, allocator);
}

struct NamedFunction {
  const char* name;
  PFN_vkVoidFunction function;
};

template <typename Function>
NamedFunction named(const char* name, Function function) {
  return {name, reinterpret_cast<PFN_vkVoidFunction>(function)};
}

}  // namespace

PFN_vkVoidFunction findDeviceFunction(const char* name) {
  static const NamedFunction functions[] = {
      named("vkGetBufferMemoryRequirements", getBufferRequirements),
      named("vkGetBufferMemoryRequirements2", getBufferRequirements2),
      named("vkGetBufferMemoryRequirements2KHR", getBufferRequirements2),
      named("vkAllocateMemory", allocate),
      named("vkFreeMemory", release),
      named("vkMapMemory", map),
      named("vkCreateComputePipelines", createPipelines),
      named("vkGetDeviceQueue", getQueue),
      named("vkQueueSubmit", submit),
      named("vkWaitForFences", waitForFences),
      named("vkGetFenceStatus", getFenceStatus),
      named("vkWaitSemaphores", waitForSemaphores),
      named("vkWaitSemaphoresKHR", waitForSemaphores),
      named("vkQueueWaitIdle", waitForQueue),
      named("vkDeviceWaitIdle", waitForDevice),
      named("vkDestroyDevice", destroyDevice),
  };
  for (const NamedFunction& each : functions)
    if (std::strcmp(name, each.name) == 0) return each.function;
  return nullptr;
}

}  // namespace asdfvk::fake
