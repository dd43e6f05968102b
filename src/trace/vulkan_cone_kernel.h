#pragma once

#include "trace/vulkan_workgroup_shape.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// The compiled shaders/trace_cone.comp for one device and ray count; serves any number of meshes.
class VulkanConeKernel {
 public:
  VulkanConeKernel(const Device& device, uint32_t rayCount);
  /// For tests that want another shape than the device's own.
  VulkanConeKernel(const Device& device, uint32_t rayCount, const VulkanWorkgroupShape& shape);

  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] const ComputePipeline& pipeline() const { return pipeline_; }
  [[nodiscard]] uint32_t rayCount() const { return rayCount_; }
  [[nodiscard]] const VulkanWorkgroupShape& shape() const { return shape_; }

 private:
  const Device& device_;
  uint32_t rayCount_;
  VulkanWorkgroupShape shape_;
  ComputePipeline pipeline_;
};

}  // namespace asdfvk
