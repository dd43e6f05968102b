#include "radv_compiler.h"

#include <cstdio>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "vk/result.h"

namespace asdfvk {
namespace {

constexpr const char* kExtension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

bool hasExtension(VkPhysicalDevice device, std::string_view name) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  for (const VkExtensionProperties& extension : extensions)
    if (name == extension.extensionName) return true;
  return false;
}

}  // namespace

std::vector<uint32_t> RadvKernel::innerLoops() const {
  struct Loop {
    uint32_t begin, end;  // Instructions.
  };
  std::map<int, uint32_t> blockBegins;
  std::vector<Loop> loops;
  uint32_t count = 0;
  std::istringstream lines(assembly);
  for (std::string line; std::getline(lines, line);) {
    int block = 0;
    if (std::sscanf(line.c_str(), "BB%d:", &block) == 1) {
      blockBegins[block] = count;
    } else if (line.starts_with('\t')) {
      ++count;
      const size_t target = line.find(" BB");
      if (line.find("branch") == std::string::npos || target == std::string::npos) continue;
      const auto begin = blockBegins.find(std::atoi(line.c_str() + target + 3));
      if (begin != blockBegins.end()) loops.push_back({begin->second, count});
    }
  }
  std::vector<uint32_t> sizes;
  for (const Loop& loop : loops) {
    bool isInner = true;
    for (const Loop& other : loops)
      isInner = isInner && (&other == &loop || other.begin < loop.begin || other.end > loop.end);
    if (isInner) sizes.push_back(loop.end - loop.begin);
  }
  return sizes;
}

RadvCompiler::RadvCompiler(const std::string& manifest, const std::string& family)
    : drivers_("VK_DRIVER_FILES", manifest),
      oldDrivers_("VK_ICD_FILENAMES", manifest),
      layers_("VK_INSTANCE_LAYERS", std::nullopt),
      family_("RADV_FORCE_FAMILY", family),
      instance_(std::make_unique<Instance>()) {
  const std::vector<VkPhysicalDevice> devices = instance_->physicalDevices();
  if (devices.empty()) return;
  facts_ = describeDevice(devices[0]);
  if (!hasExtension(devices[0], kExtension) || facts_.vendor != DeviceVendor::Amd || !facts_.computeQueueFamily) return;

  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR feature{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
  feature.pipelineExecutableInfo = VK_TRUE;
  VkPhysicalDeviceSubgroupSizeControlFeaturesEXT subgroupSizes{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES_EXT};
  subgroupSizes.subgroupSizeControl = VK_TRUE;
  std::vector<const char*> extensions{kExtension};
  if (facts_.maxRequiredSubgroupSize > 0) {
    feature.pNext = &subgroupSizes;
    extensions.push_back(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
  }
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = *facts_.computeQueueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &feature;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  requireSuccess(vkCreateDevice(devices[0], &info, nullptr, &device_), "opening RADV");
}

RadvCompiler::~RadvCompiler() {
  if (device_) vkDestroyDevice(device_, nullptr);
}

int RadvCompiler::majorVersion() const {
  int major = 0;
  return std::sscanf(facts_.driver.c_str(), "radv Mesa %d", &major) == 1 ? major : 0;
}

RadvKernel RadvCompiler::compile(ComputePipelineDescription description) const {
  description.flags =
      VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;
  return describe(ComputePipeline(device_, description).handle());
}

RadvKernel RadvCompiler::describe(VkPipeline pipeline) const {
  VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR};
  info.pipeline = pipeline;
  RadvKernel kernel;
  uint32_t count = 0;
  requireSuccess(vkGetPipelineExecutableStatisticsKHR(device_, &info, &count, nullptr), "reading statistics");
  std::vector<VkPipelineExecutableStatisticKHR> all(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
  requireSuccess(vkGetPipelineExecutableStatisticsKHR(device_, &info, &count, all.data()), "reading statistics");
  for (const VkPipelineExecutableStatisticKHR& one : all)
    if (one.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR) kernel.statistics[one.name] = one.value.u64;

  const auto readTexts = [&](VkPipelineExecutableInternalRepresentationKHR* texts) {
    requireSuccess(vkGetPipelineExecutableInternalRepresentationsKHR(device_, &info, &count, texts), "reading code");
  };
  readTexts(nullptr);
  std::vector<VkPipelineExecutableInternalRepresentationKHR> texts(
      count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR});
  readTexts(texts.data());  // Sizes only.
  std::vector<std::string> contents;
  for (const VkPipelineExecutableInternalRepresentationKHR& text : texts) contents.emplace_back(text.dataSize, '\0');
  for (uint32_t i = 0; i < count; ++i) texts[i].pData = contents[i].data();
  readTexts(texts.data());
  for (uint32_t i = 0; i < count; ++i)
    if (std::string_view(texts[i].name) == "Assembly") kernel.assembly = contents[i].c_str();
  return kernel;
}

}  // namespace asdfvk
