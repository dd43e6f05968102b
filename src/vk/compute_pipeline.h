#pragma once

#include <volk.h>

#include <span>
#include <string>
#include <vector>

#include "vk/buffer.h"
#include "vk/device.h"

namespace asdfvk {

/// The value of a specialization constant: the bits of a uint, an int or a float, or a VkBool32.
struct SpecializationConstant {
  uint32_t id;  ///< layout(constant_id = id) or layout(local_size_x_id = id) in the shader.
  uint32_t value;
};

/// An entry per constant; the data are the constants themselves.
[[nodiscard]] std::vector<VkSpecializationMapEntry> specializationEntries(
    std::span<const SpecializationConstant> constants);

struct ComputePipelineDescription {
  std::string name;  ///< Name of the shader, for messages.
  std::span<const uint32_t> spirv;
  std::vector<VkDescriptorType> bindings;  ///< Binding i of set 0 has type bindings[i].
  uint32_t pushConstantByteCount = 0;
  std::vector<SpecializationConstant> specializationConstants;  ///< Ids that the shader lacks have no effect.
  /// Lanes per subgroup; 0: chosen by the driver. See canRequireSubgroupSize().
  uint32_t requiredSubgroupSize = 0;
  VkPipelineCreateFlags flags = 0;
};

class ComputePipeline {
 public:
  /// Throws Error{DeviceLimit} if the device has too few storage buffers.
  ComputePipeline(const Device& device, const ComputePipelineDescription& description);
  ComputePipeline(VkDevice device, const ComputePipelineDescription& description);
  ~ComputePipeline();
  ComputePipeline(const ComputePipeline&) = delete;
  ComputePipeline& operator=(const ComputePipeline&) = delete;

  [[nodiscard]] VkPipeline handle() const { return pipeline_; }
  [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
  [[nodiscard]] VkDescriptorSetLayout setLayout() const { return setLayout_; }
  [[nodiscard]] const std::vector<VkDescriptorType>& bindings() const { return bindings_; }

 private:
  void destroy();
  VkDevice device_;
  std::vector<VkDescriptorType> bindings_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// The resource of a binding: a whole buffer or a texel view.
struct Binding {
  Binding(const Buffer& storage) : buffer(storage.handle()), byteCount(storage.byteCount()) {}
  Binding(const TexelView& texels) : view(texels.handle()) {}
  VkBuffer buffer = VK_NULL_HANDLE;
  uint64_t byteCount = 0;
  VkBufferView view = VK_NULL_HANDLE;
};

/// The buffers of the dispatches of a pipeline. The buffers must outlive the set.
class BindingSet {
 public:
  /// Throws Error{DeviceLimit} for a buffer larger than DeviceFacts::maxStorageBufferRange.
  BindingSet(const Device& device, const ComputePipeline& pipeline, std::span<const Binding> bindings);
  ~BindingSet();
  BindingSet(const BindingSet&) = delete;
  BindingSet& operator=(const BindingSet&) = delete;

  [[nodiscard]] VkDescriptorSet handle() const { return set_.handle; }

 private:
  DescriptorSets& sets_;
  DescriptorSets::Set set_;
};

}  // namespace asdfvk
