// What the layer reports of a physical device.
#include <algorithm>
#include <cstring>

#include "state.h"

namespace asdfvk::fake {
namespace {

template <typename Limit>
void reduce(Limit& limit, const auto& setting) {
  if (setting) limit = std::min(limit, static_cast<Limit>(*setting));
}

void change(VkPhysicalDeviceProperties& properties, const Settings& settings) {
  if (!settings.name.empty()) std::strcpy(properties.deviceName, settings.name.c_str());
  if (settings.minorVersion) properties.apiVersion = VK_MAKE_API_VERSION(0, 1, *settings.minorVersion, 0);
  properties.deviceType = settings.type.value_or(properties.deviceType);
  properties.vendorID = settings.vendor.value_or(properties.vendorID);
  VkPhysicalDeviceLimits& limits = properties.limits;
  reduce(limits.maxTexelBufferElements, settings.texelCount);
  reduce(limits.maxStorageBufferRange, settings.storageBufferRange);
  reduce(limits.maxPerStageDescriptorStorageBuffers, settings.storageBufferCount);
  reduce(limits.maxDescriptorSetStorageBuffers, settings.storageBufferCount);
  reduce(limits.maxComputeWorkGroupInvocations, settings.workgroupInvocations);
  for (const int axis : {0, 1}) reduce(limits.maxComputeWorkGroupSize[axis], settings.workgroupSize);
  reduce(limits.maxComputeSharedMemorySize, settings.sharedMemoryByteCount);
}

void change(VkPhysicalDeviceProperties2& properties, const Settings& settings) {
  change(properties.properties, settings);
  for (auto* next = static_cast<VkBaseOutStructure*>(properties.pNext); next != nullptr; next = next->pNext) {
    switch (next->sType) {
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES: {
        auto& subgroup = *reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next);
        subgroup.subgroupSize = settings.subgroupSize.value_or(subgroup.subgroupSize);
        break;
      }
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES:
        reduce(reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(next)->maxMemoryAllocationSize,
               settings.maxAllocationByteCount);
        break;
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES_EXT: {
        auto& sizes = *reinterpret_cast<VkPhysicalDeviceSubgroupSizeControlPropertiesEXT*>(next);
        sizes.minSubgroupSize = settings.minSubgroupSize.value_or(sizes.minSubgroupSize);
        sizes.maxSubgroupSize = settings.maxSubgroupSize.value_or(sizes.maxSubgroupSize);
        if (settings.maxSubgroupSize) sizes.requiredSubgroupSizeStages |= VK_SHADER_STAGE_COMPUTE_BIT;
        break;
      }
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES: {
        auto& core = *reinterpret_cast<VkPhysicalDeviceVulkan11Properties*>(next);
        core.subgroupSize = settings.subgroupSize.value_or(core.subgroupSize);
        reduce(core.maxMemoryAllocationSize, settings.maxAllocationByteCount);
        break;
      }
      default:
        break;
    }
  }
}

void change(VkPhysicalDeviceMemoryProperties& memory, const Settings& settings) {
  if (!settings.hasSeparateMemory) return;
  constexpr VkMemoryPropertyFlags kMappable =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const VkDeviceSize byteCount = memory.memoryHeaps[0].size;
  memory = {};
  memory.memoryHeapCount = 2;
  memory.memoryHeaps[0] = {byteCount, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  memory.memoryHeaps[1] = {byteCount, 0};
  memory.memoryTypeCount = separateTypeCount(settings);
  memory.memoryTypes[kLocalType] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
  memory.memoryTypes[kHostType] = {kMappable, 1};
  memory.memoryTypes[kCachedHostType] = {kMappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 1};
  if (!settings.mappableByteCount) return;
  memory.memoryHeapCount = 3;
  memory.memoryHeaps[2] = {*settings.mappableByteCount, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  memory.memoryTypes[kMappableLocalType] = {kMappable | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 2};
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
  const InstanceState& instance = instances().of(device);
  instance.next.getProperties(device, properties);
  change(*properties, instance.settings);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
  const InstanceState& instance = instances().of(device);
  instance.next.getProperties2(device, properties);
  change(*properties, instance.settings);
}

VKAPI_ATTR void VKAPI_CALL getMemory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
  const InstanceState& instance = instances().of(device);
  instance.next.getMemory(device, memory);
  change(*memory, instance.settings);
}

VKAPI_ATTR void VKAPI_CALL getMemory2(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2* memory) {
  const InstanceState& instance = instances().of(device);
  instance.next.getMemory2(device, memory);
  change(memory->memoryProperties, instance.settings);
}

VKAPI_ATTR void VKAPI_CALL getQueueFamilies(VkPhysicalDevice device, uint32_t* count,
                                            VkQueueFamilyProperties* families) {
  const InstanceState& instance = instances().of(device);
  instance.next.getQueueFamilies(device, count, families);
  for (uint32_t i = 0; families != nullptr && i < *count; ++i)
    families[i].queueCount = instance.settings.queueCount.value_or(families[i].queueCount);
}

}  // namespace

uint32_t findMappableType(const InstanceState& instance, VkPhysicalDevice device) {
  constexpr VkMemoryPropertyFlags kMappable =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkPhysicalDeviceMemoryProperties memory{};
  instance.next.getMemory(device, &memory);
  uint32_t type = 0;
  while (type + 1 < memory.memoryTypeCount && (memory.memoryTypes[type].propertyFlags & kMappable) != kMappable) ++type;
  return type;
}

PFN_vkVoidFunction findPhysicalDeviceFunction(const char* name) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
  if (is("vkGetPhysicalDeviceProperties")) return reinterpret_cast<PFN_vkVoidFunction>(getProperties);
  if (is("vkGetPhysicalDeviceProperties2") || is("vkGetPhysicalDeviceProperties2KHR"))
    return reinterpret_cast<PFN_vkVoidFunction>(getProperties2);
  if (is("vkGetPhysicalDeviceMemoryProperties")) return reinterpret_cast<PFN_vkVoidFunction>(getMemory);
  if (is("vkGetPhysicalDeviceMemoryProperties2") || is("vkGetPhysicalDeviceMemoryProperties2KHR"))
    return reinterpret_cast<PFN_vkVoidFunction>(getMemory2);
  if (is("vkGetPhysicalDeviceQueueFamilyProperties")) return reinterpret_cast<PFN_vkVoidFunction>(getQueueFamilies);
  return nullptr;
}

}  // namespace asdfvk::fake
