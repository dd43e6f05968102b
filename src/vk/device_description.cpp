#include "vk/device_description.h"

#include <volk.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk {
namespace {

using FlagName = std::pair<VkFlags, const char*>;

constexpr FlagName kMemoryFlags[]{{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "deviceLocal"},
                                  {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT, "hostVisible"},
                                  {VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, "hostCoherent"},
                                  {VK_MEMORY_PROPERTY_HOST_CACHED_BIT, "hostCached"},
                                  {VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, "lazilyAllocated"},
                                  {VK_MEMORY_PROPERTY_PROTECTED_BIT, "protected"},
                                  {VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD, "deviceCoherent"},
                                  {VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD, "deviceUncached"}};
constexpr FlagName kQueueFlags[]{{VK_QUEUE_GRAPHICS_BIT, "graphics"},
                                 {VK_QUEUE_COMPUTE_BIT, "compute"},
                                 {VK_QUEUE_TRANSFER_BIT, "transfer"},
                                 {VK_QUEUE_PROTECTED_BIT, "protected"}};
constexpr FlagName kSubgroupOperations[]{
    {VK_SUBGROUP_FEATURE_BASIC_BIT, "basic"},           {VK_SUBGROUP_FEATURE_VOTE_BIT, "vote"},
    {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "arithmetic"}, {VK_SUBGROUP_FEATURE_BALLOT_BIT, "ballot"},
    {VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "shuffle"},       {VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT, "shuffleRelative"},
    {VK_SUBGROUP_FEATURE_CLUSTERED_BIT, "clustered"},   {VK_SUBGROUP_FEATURE_QUAD_BIT, "quad"}};
constexpr std::string_view kExtensions[]{"VK_AMD_memory_overallocation_behavior",
                                         "VK_EXT_external_memory_host",
                                         "VK_EXT_memory_budget",
                                         "VK_EXT_pipeline_creation_cache_control",
                                         "VK_EXT_subgroup_size_control",
                                         "VK_KHR_pipeline_executable_properties",
                                         "VK_KHR_portability_subset",
                                         "VK_KHR_ray_query",
                                         "VK_KHR_shader_maximal_reconvergence",
                                         "VK_KHR_shader_subgroup_uniform_control_flow",
                                         "VK_NV_shader_sm_builtins"};

std::vector<std::string> namesOf(std::span<const FlagName> names, VkFlags flags) {
  std::vector<std::string> result;
  for (const auto& [flag, name] : names)
    if (flags & flag) result.emplace_back(name);
  return result;
}

std::vector<std::pair<std::string, uint64_t>> limitsOf(const VkPhysicalDeviceLimits& limits, uint64_t allocationSize) {
  return {{"maxComputeWorkGroupInvocations", limits.maxComputeWorkGroupInvocations},
          {"maxComputeWorkGroupSizeX", limits.maxComputeWorkGroupSize[0]},
          {"maxComputeWorkGroupSizeY", limits.maxComputeWorkGroupSize[1]},
          {"maxComputeWorkGroupCountX", limits.maxComputeWorkGroupCount[0]},
          {"maxComputeWorkGroupCountY", limits.maxComputeWorkGroupCount[1]},
          {"maxComputeSharedMemorySize", limits.maxComputeSharedMemorySize},
          {"maxStorageBufferRange", limits.maxStorageBufferRange},
          {"maxTexelBufferElements", limits.maxTexelBufferElements},
          {"maxPerStageDescriptorStorageBuffers", limits.maxPerStageDescriptorStorageBuffers},
          {"maxPerStageDescriptorStorageImages", limits.maxPerStageDescriptorStorageImages},
          {"maxPerStageResources", limits.maxPerStageResources},
          {"maxPushConstantsSize", limits.maxPushConstantsSize},
          {"maxMemoryAllocationSize", allocationSize},
          {"maxMemoryAllocationCount", limits.maxMemoryAllocationCount},
          {"minStorageBufferOffsetAlignment", limits.minStorageBufferOffsetAlignment},
          {"minMemoryMapAlignment", limits.minMemoryMapAlignment},
          {"nonCoherentAtomSize", limits.nonCoherentAtomSize},
          {"timestampComputeAndGraphics", limits.timestampComputeAndGraphics}};
}

/// Features of the device, and rules of its float32.
std::vector<std::string> featuresOf(VkPhysicalDevice device, const VkPhysicalDeviceFloatControlsProperties& floats) {
  VkPhysicalDeviceVulkan12Features newer{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &newer, {}};
  vkGetPhysicalDeviceFeatures2(device, &all);
  const std::pair<VkBool32, const char*> features[]{
      {all.features.robustBufferAccess, "robustBufferAccess"},
      {all.features.shaderFloat64, "shaderFloat64"},
      {all.features.shaderInt64, "shaderInt64"},
      {all.features.shaderInt16, "shaderInt16"},
      {newer.shaderFloat16, "shaderFloat16"},
      {newer.storageBuffer8BitAccess, "storageBuffer8BitAccess"},
      {newer.bufferDeviceAddress, "bufferDeviceAddress"},
      {newer.timelineSemaphore, "timelineSemaphore"},
      {newer.hostQueryReset, "hostQueryReset"},
      {newer.vulkanMemoryModel, "vulkanMemoryModel"},
      {newer.shaderSubgroupExtendedTypes, "shaderSubgroupExtendedTypes"},
      {floats.shaderSignedZeroInfNanPreserveFloat32, "shaderSignedZeroInfNanPreserveFloat32"},
      {floats.shaderDenormPreserveFloat32, "shaderDenormPreserveFloat32"},
      {floats.shaderDenormFlushToZeroFloat32, "shaderDenormFlushToZeroFloat32"},
      {floats.shaderRoundingModeRTEFloat32, "shaderRoundingModeRTEFloat32"}};
  std::vector<std::string> result;
  for (const auto& [has, name] : features)
    if (has) result.emplace_back(name);
  return result;
}

std::vector<std::string> extensionsOf(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> all(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data());
  std::vector<std::string> result;
  for (const std::string_view name : kExtensions)
    if (std::any_of(all.begin(), all.end(), [&](const auto& extension) { return name == extension.extensionName; }))
      result.emplace_back(name);
  return result;
}

}  // namespace

DeviceDescription describeInFull(const Instance& instance, uint32_t index) {
  const VkPhysicalDevice device = instance.physicalDevices().at(index);
  VkPhysicalDeviceFloatControlsProperties floats{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES};
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, &floats};
  VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES, &driver};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup, {}};
  vkGetPhysicalDeviceProperties2(device, &properties);
  const VkPhysicalDeviceProperties& basic = properties.properties;

  DeviceDescription description;
  description.facts = describeDevice(device);
  description.vendorId = basic.vendorID;
  description.deviceId = basic.deviceID;
  description.driverId = static_cast<uint32_t>(driver.driverID);
  description.driverVersion = basic.driverVersion;
  description.limits = limitsOf(basic.limits, description.facts.maxMemoryAllocationSize);
  if (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT)
    description.subgroupOperations = namesOf(kSubgroupOperations, subgroup.supportedOperations);
  description.features = featuresOf(device, floats);
  description.extensions = extensionsOf(device);

  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  for (const VkMemoryHeap& heap : std::span(memory.memoryHeaps, memory.memoryHeapCount))
    description.heaps.push_back({heap.size, (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0});
  for (const VkMemoryType& type : std::span(memory.memoryTypes, memory.memoryTypeCount))
    description.memoryTypes.push_back({type.heapIndex, namesOf(kMemoryFlags, type.propertyFlags)});

  uint32_t familyCount = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &familyCount, nullptr);
  std::vector<VkQueueFamilyProperties> families(familyCount);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &familyCount, families.data());
  for (const VkQueueFamilyProperties& family : families)
    description.queueFamilies.push_back(
        {family.queueCount, namesOf(kQueueFlags, family.queueFlags), family.timestampValidBits});
  return description;
}

}  // namespace asdfvk
