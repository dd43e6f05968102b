// Occupancy of the kernels on AMD GPUs, as Mesa's compiler reports it without the hardware.
#include <doctest/doctest.h>

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/mesa_driver.h"
#include "support/scoped_variable.h"
#include "trace/vk/vulkan_cone_kernel.h"
#include "vk/instance.h"
#include "vk/result.h"

using namespace asdfvk;

namespace {

using Statistics = std::map<std::string, uint64_t>;

/// The driver RADV for a family of GPUs that need not be there. RADV ends the process for a family that it does not
/// have.
class RadvCompiler {
 public:
  RadvCompiler(const std::string& manifest, const std::string& family)
      : drivers_("VK_DRIVER_FILES", manifest),
        oldDrivers_("VK_ICD_FILENAMES", manifest),
        layers_("VK_INSTANCE_LAYERS", std::nullopt),
        family_("RADV_FORCE_FAMILY", family),
        instance_(std::make_unique<Instance>()) {
    const std::vector<VkPhysicalDevice> devices = instance_->physicalDevices();
    if (devices.empty()) return;
    facts_ = describeDevice(devices[0]);
    uint32_t extensionCount = 0;
    vkEnumerateDeviceExtensionProperties(devices[0], nullptr, &extensionCount, nullptr);
    std::vector<VkExtensionProperties> extensions(extensionCount);
    vkEnumerateDeviceExtensionProperties(devices[0], nullptr, &extensionCount, extensions.data());
    bool hasStatistics = false;
    for (const VkExtensionProperties& extension : extensions)
      hasStatistics = hasStatistics || std::string_view(extension.extensionName) == kExtension;
    if (!hasStatistics || facts_.vendor != DeviceVendor::Amd || !facts_.computeQueueFamily) return;

    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR feature{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
    feature.pipelineExecutableInfo = VK_TRUE;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = *facts_.computeQueueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &feature;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &kExtension;
    requireSuccess(vkCreateDevice(devices[0], &info, nullptr, &device_), "opening RADV");
  }
  ~RadvCompiler() {
    if (device_) vkDestroyDevice(device_, nullptr);
  }
  RadvCompiler(const RadvCompiler&) = delete;
  RadvCompiler& operator=(const RadvCompiler&) = delete;

  [[nodiscard]] bool isUsable() const { return device_ != VK_NULL_HANDLE; }
  [[nodiscard]] const DeviceFacts& facts() const { return facts_; }
  /// Major version of Mesa; 0 if the driver reports none.
  [[nodiscard]] int majorVersion() const {
    int major = 0;
    return std::sscanf(facts_.driver.c_str(), "radv Mesa %d", &major) == 1 ? major : 0;
  }

  [[nodiscard]] Statistics compile(const ComputePipelineDescription& description) const {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < description.bindings.size(); ++i)
      bindings.push_back({i, description.bindings[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<uint32_t>(bindings.size());
    setInfo.pBindings = bindings.data();
    VkDescriptorSetLayout set = VK_NULL_HANDLE;
    requireSuccess(vkCreateDescriptorSetLayout(device_, &setInfo, nullptr, &set), description.name);
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, description.pushConstantByteCount};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &set;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    requireSuccess(vkCreatePipelineLayout(device_, &layoutInfo, nullptr, &layout), description.name);
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = description.spirv.size_bytes();
    moduleInfo.pCode = description.spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    requireSuccess(vkCreateShaderModule(device_, &moduleInfo, nullptr, &module), description.name);

    const std::vector<VkSpecializationMapEntry> entries = specializationEntries(description.specializationConstants);
    const VkSpecializationInfo specialization{
        static_cast<uint32_t>(entries.size()), entries.data(),
        description.specializationConstants.size() * sizeof(SpecializationConstant),
        description.specializationConstants.data()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    requireSuccess(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), description.name);
    Statistics statistics = statisticsOf(pipeline);
    vkDestroyPipeline(device_, pipeline, nullptr);
    vkDestroyShaderModule(device_, module, nullptr);
    vkDestroyPipelineLayout(device_, layout, nullptr);
    vkDestroyDescriptorSetLayout(device_, set, nullptr);
    return statistics;
  }

 private:
  static constexpr const char* kExtension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

  [[nodiscard]] Statistics statisticsOf(VkPipeline pipeline) const {
    VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR};
    info.pipeline = pipeline;
    uint32_t count = 0;
    requireSuccess(vkGetPipelineExecutableStatisticsKHR(device_, &info, &count, nullptr), "reading statistics");
    std::vector<VkPipelineExecutableStatisticKHR> all(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    requireSuccess(vkGetPipelineExecutableStatisticsKHR(device_, &info, &count, all.data()), "reading statistics");
    Statistics statistics;
    for (const VkPipelineExecutableStatisticKHR& one : all)
      if (one.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR) statistics[one.name] = one.value.u64;
    return statistics;
  }

  test::ScopedVariable drivers_, oldDrivers_, layers_, family_;
  std::unique_ptr<Instance> instance_;
  DeviceFacts facts_;
  VkDevice device_ = VK_NULL_HANDLE;
};

ComputePipelineDescription conesOn(const DeviceFacts& facts, TraceKernel kernel, const VulkanWalkShape& walk) {
  const ConeKernelRequest request{.rayCount = 30, .writesHits = true};
  VulkanTraceChoice choice = defaultTraceChoice(facts);
  choice.kernel = kernel;
  return describeRays(request, choice, workgroupShapeFor(facts, request.rayCount, kernel), walk);
}

constexpr const char* kOccupancy = "Subgroups per SIMD";

}  // namespace

TEST_CASE("the stacks of a lane leave AMD GPUs their occupancy" * doctest::test_suite("slow")) {
  const std::string manifest = test::mesaDriver("radeon");
  if (manifest.empty()) {
    MESSAGE("skipped: no RADV driver");
    return;
  }
  struct Family {
    std::string name;
    uint64_t rayCount, seedCount;  // At least so many subgroups per SIMD.
  };
  std::vector<Family> families;
  {
    const RadvCompiler radv(manifest, "navi21");
    if (!radv.isUsable()) {
      MESSAGE("skipped: RADV has no statistics of pipelines: " << radv.facts().driver);
      return;
    }
    MESSAGE(radv.facts().driver);
    families = {{"vega10", 3, 3}, {"navi21", 10, 12}};
    // The name of the family Navi 31 changed between these versions.
    if (radv.majorVersion() == 22) families.push_back({"gfx1100", 16, 18});
    if (radv.majorVersion() >= 25) families.push_back({"navi31", 16, 18});
  }
  for (const Family& family : families) {
    CAPTURE(family.name);
    const RadvCompiler radv(manifest, family.name);
    REQUIRE(radv.isUsable());
    const VulkanWalkShape walk = walkShapeFor(radv.facts());
    Statistics ray = radv.compile(conesOn(radv.facts(), TraceKernel::Ray, walk)),
               seed = radv.compile(conesOn(radv.facts(), TraceKernel::Seed, walk));
    MESSAGE(family.name << ": ray " << ray[kOccupancy] << ", seed " << seed[kOccupancy]);
    CHECK(ray[kOccupancy] >= family.rayCount);
    CHECK(seed[kOccupancy] >= family.seedCount);
    for (Statistics* statistics : {&ray, &seed}) {
      CHECK((*statistics)["Scratch size"] > 0);
      CHECK((*statistics)["Spilled VGPRs"] == 0);
    }
  }
  // Control: with the shape for CPU devices the stacks are in registers.
  const RadvCompiler radv(manifest, "navi21");
  Statistics seed = radv.compile(conesOn(radv.facts(), TraceKernel::Seed, VulkanWalkShape{}));
  CHECK(seed[kOccupancy] < 8);
  CHECK(seed["Scratch size"] == 0);
}
