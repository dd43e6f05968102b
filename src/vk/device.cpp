#include "vk/device.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "vk/result.h"
#include "vk/upload_queue.h"

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

bool hasExtension(VkPhysicalDevice device, const char* name) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

/// Drivers of Vulkan 1.3 offer this extension too, so that instances of Vulkan 1.2 suffice.
constexpr const char* kSubgroupSizeControl = VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME;

bool requiresSubgroupSizes(const DeviceFacts& device) { return device.maxRequiredSubgroupSize > 0; }

std::vector<const char*> extensionsFor(VkPhysicalDevice physical, const DeviceFacts& facts) {
  // A device that has this extension must be opened with it.
  constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";
  std::vector<const char*> names;
  if (hasExtension(physical, kPortabilitySubset)) names.push_back(kPortabilitySubset);
  if (requiresSubgroupSizes(facts)) names.push_back(kSubgroupSizeControl);
  return names;
}

void describeSubgroupSizes(VkPhysicalDevice device, DeviceFacts& facts) {
  if (!hasExtension(device, kSubgroupSizeControl)) return;
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

OpenedDevice openDevice(const Instance& instance, const DeviceRequest& request) {
  const std::vector<VkPhysicalDevice> physical = instance.physicalDevices();
  if (physical.empty()) throw Error(ErrorCode::NoVulkanDriver, "no Vulkan device was found");
  std::vector<DeviceFacts> facts;
  for (const VkPhysicalDevice device : physical) facts.push_back(describeDevice(device));
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
  return {std::make_unique<Device>(physical[*choice.index], facts[*choice.index]), std::move(reasons)};
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
  if (facts.computeQueueFamily) facts.timestampBits = families[*facts.computeQueueFamily].timestampValidBits;
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

Device::Device(VkPhysicalDevice physical, DeviceFacts facts) : facts_(std::move(facts)) {
  vkGetPhysicalDeviceMemoryProperties(physical, &memoryTypes_);
  const float priority = 1;
  VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queueInfo.queueFamilyIndex = facts_.computeQueueFamily.value();
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
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
  vkGetDeviceQueue(device, *facts_.computeQueueFamily, 0, &queue_);
  memory_ = std::make_unique<MemoryArena>(*this);
  descriptorSets_ = std::make_unique<DescriptorSets>(device);
  commandPool_ = std::make_unique<CommandPool>(device, facts_);
  uploads_ = std::make_unique<UploadQueue>(*this);
}

Device::~Device() { uploads_->finishAll(); }

}  // namespace asdfvk
