#include "vk/physical_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace asdfvk {
namespace {

DeviceKind kindOf(VkPhysicalDeviceType type) {
  constexpr DeviceKind kKinds[]{DeviceKind::Other, DeviceKind::Integrated, DeviceKind::Discrete, DeviceKind::Virtual,
                                DeviceKind::Cpu};
  static_assert(VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU == 1 && VK_PHYSICAL_DEVICE_TYPE_CPU == 4);
  return static_cast<size_t>(type) < std::size(kKinds) ? kKinds[type] : DeviceKind::Other;
}

DeviceVendor vendorOf(uint32_t pciId) {
  return pciId == 0x10de   ? DeviceVendor::Nvidia
         : pciId == 0x1002 ? DeviceVendor::Amd
         : pciId == 0x8086 ? DeviceVendor::Intel
                           : DeviceVendor::Other;
}

std::vector<VkQueueFamilyProperties> queueFamilies(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

void describeSubgroupSizes(VkPhysicalDevice device, DeviceFacts& facts) {
  if (!offersExtension(device, VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME)) return;
  VkPhysicalDeviceSubgroupSizeControlFeaturesEXT feature{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES_EXT};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &feature, {}};
  vkGetPhysicalDeviceFeatures2(device, &features);
  VkPhysicalDeviceSubgroupSizeControlPropertiesEXT sizes{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES_EXT};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &sizes, {}};
  vkGetPhysicalDeviceProperties2(device, &properties);
  if (!feature.subgroupSizeControl || !(sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT)) return;
  facts.minRequiredSubgroupSize = sizes.minSubgroupSize;
  facts.maxRequiredSubgroupSize = sizes.maxSubgroupSize;
}

}  // namespace

std::optional<uint32_t> chooseComputeQueueFamily(std::span<const VkQueueFamilyProperties> families) {
  std::optional<uint32_t> found;
  for (uint32_t i = 0; i < families.size(); ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
    if (!(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)) return i;
    if (!found) found = i;
  }
  return found;
}

bool offersExtension(VkPhysicalDevice device, const char* name) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

DeviceFacts describeDevice(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties basic{};
  vkGetPhysicalDeviceProperties(device, &basic);
  DeviceFacts facts;
  facts.name = basic.deviceName;
  facts.kind = kindOf(basic.deviceType);
  facts.vendor = vendorOf(basic.vendorID);
  facts.apiVersion = basic.apiVersion;
  const std::vector<VkQueueFamilyProperties> families = queueFamilies(device);
  facts.computeQueueFamily = chooseComputeQueueFamily(families);
  if (facts.computeQueueFamily) {
    facts.computeQueueCount = families[*facts.computeQueueFamily].queueCount;
    facts.timestampBits = families[*facts.computeQueueFamily].timestampValidBits;
  }
  facts.secondsPerTimestamp = static_cast<double>(basic.limits.timestampPeriod) * 1e-9;
  facts.maxWorkgroupInvocations = basic.limits.maxComputeWorkGroupInvocations;
  facts.maxWorkgroupSize = basic.limits.maxComputeWorkGroupSize[0];
  facts.maxStorageBuffersPerStage = basic.limits.maxPerStageDescriptorStorageBuffers;
  facts.maxWorkgroupCount = basic.limits.maxComputeWorkGroupCount[0];
  facts.maxStorageBufferRange = basic.limits.maxStorageBufferRange;
  facts.maxTexelBufferElements = basic.limits.maxTexelBufferElements;
  if (basic.apiVersion < VK_API_VERSION_1_2) return facts;  // The structures below need Vulkan 1.1 and 1.2.

  VkPhysicalDeviceMaintenance3Properties maintenance{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
  VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES, &maintenance};
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, &subgroup};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
  vkGetPhysicalDeviceProperties2(device, &properties);
  facts.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
  facts.endsLongLoops = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE && llvmpipeEndsLongLoops(driver.driverInfo);
  facts.subgroupSize = subgroup.subgroupSize;
  const auto offers = [&](VkSubgroupFeatureFlagBits operations) {
    return (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
           (subgroup.supportedOperations & operations) != 0;
  };
  facts.hasSubgroupVote = offers(VK_SUBGROUP_FEATURE_VOTE_BIT);
  facts.hasSubgroupArithmetic = offers(VK_SUBGROUP_FEATURE_ARITHMETIC_BIT) && offers(VK_SUBGROUP_FEATURE_BALLOT_BIT);
  facts.maxMemoryAllocationSize = maintenance.maxMemoryAllocationSize;
  describeSubgroupSizes(device, facts);
  return facts;
}

std::vector<DeviceFacts> describeDevices(std::span<const VkPhysicalDevice> devices) {
  std::vector<DeviceFacts> facts;
  for (const VkPhysicalDevice device : devices) facts.push_back(describeDevice(device));
  return facts;
}

}  // namespace asdfvk
