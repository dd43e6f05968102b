#include "vk/compute_pipeline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "vk/result.h"

namespace asdfvk {

namespace {

/// Returns the handle of the device.
VkDevice requireStorageBuffers(const Device& device, const ComputePipelineDescription& description) {
  const auto count =
      std::count(description.bindings.begin(), description.bindings.end(), VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  if (count > device.facts().maxStorageBuffersPerStage)
    throw Error(ErrorCode::DeviceLimit,
                fmt::format("{} needs {} storage buffers and {} has {}", description.name, count, device.facts().name,
                            device.facts().maxStorageBuffersPerStage));
  return device.handle();
}

}  // namespace

std::vector<VkSpecializationMapEntry> specializationEntries(std::span<const SpecializationConstant> constants) {
  std::vector<VkSpecializationMapEntry> entries;
  for (size_t i = 0; i < constants.size(); ++i) {
    const size_t offset = i * sizeof(SpecializationConstant) + offsetof(SpecializationConstant, value);
    entries.push_back({constants[i].id, static_cast<uint32_t>(offset), sizeof(SpecializationConstant::value)});
  }
  return entries;
}

ComputePipeline::ComputePipeline(const Device& device, const ComputePipelineDescription& description)
    : ComputePipeline(requireStorageBuffers(device, description), description) {}

ComputePipeline::ComputePipeline(VkDevice device, const ComputePipelineDescription& description)
    : device_(device), bindings_(description.bindings) {
  VkShaderModule module = VK_NULL_HANDLE;
  try {
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    for (uint32_t i = 0; i < bindings_.size(); ++i)
      layoutBindings.push_back({i, bindings_[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<uint32_t>(layoutBindings.size());
    setInfo.pBindings = layoutBindings.data();
    requireSuccess(vkCreateDescriptorSetLayout(device_, &setInfo, nullptr, &setLayout_), description.name);

    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, description.pushConstantByteCount};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout_;
    layoutInfo.pushConstantRangeCount = description.pushConstantByteCount > 0 ? 1 : 0;
    layoutInfo.pPushConstantRanges = &range;
    requireSuccess(vkCreatePipelineLayout(device_, &layoutInfo, nullptr, &layout_), description.name);

    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = description.spirv.size_bytes();
    moduleInfo.pCode = description.spirv.data();
    requireSuccess(vkCreateShaderModule(device_, &moduleInfo, nullptr, &module), description.name);

    const std::vector<VkSpecializationMapEntry> entries = specializationEntries(description.specializationConstants);
    const VkSpecializationInfo specialization{
        static_cast<uint32_t>(entries.size()), entries.data(),
        description.specializationConstants.size() * sizeof(SpecializationConstant),
        description.specializationConstants.data()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.flags = description.flags;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    VkPipelineShaderStageRequiredSubgroupSizeCreateInfoEXT subgroups{
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO_EXT};
    subgroups.requiredSubgroupSize = description.requiredSubgroupSize;
    if (description.requiredSubgroupSize > 0) info.stage.pNext = &subgroups;
    info.layout = layout_;
    requireSuccess(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
                   "compiling " + description.name);
  } catch (...) {
    vkDestroyShaderModule(device_, module, nullptr);
    destroy();
    throw;
  }
  vkDestroyShaderModule(device_, module, nullptr);
}

ComputePipeline::~ComputePipeline() { destroy(); }

void ComputePipeline::destroy() {
  vkDestroyPipeline(device_, pipeline_, nullptr);
  vkDestroyPipelineLayout(device_, layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_, setLayout_, nullptr);
}

BindingSet::BindingSet(const Device& device, const ComputePipeline& pipeline, std::span<const Binding> bindings)
    : sets_(device.descriptorSets()) {
  ASDFVK_CHECK_OP(bindings.size(), ==, pipeline.bindings().size());
  for (const Binding& binding : bindings) requireStorageRange(device, binding.byteCount);
  set_ = sets_.take(pipeline.setLayout());
  std::vector<VkDescriptorBufferInfo> buffers(bindings.size());
  std::vector<VkWriteDescriptorSet> writes(bindings.size());
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    buffers[i] = {bindings[i].buffer, 0, VK_WHOLE_SIZE};
    writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes[i].dstSet = set_.handle;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = pipeline.bindings()[i];
    if (bindings[i].view) {
      writes[i].pTexelBufferView = &bindings[i].view;
    } else {
      writes[i].pBufferInfo = &buffers[i];
    }
  }
  vkUpdateDescriptorSets(device.handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

BindingSet::~BindingSet() { sets_.give(set_); }

}  // namespace asdfvk
