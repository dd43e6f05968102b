#pragma once

#include <compare>
#include <cstdint>

#include "trace/vulkan_workgroup_shape.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// What a kernel is compiled for.
struct ConeKernelRequest {
  uint32_t rayCount;
  bool writesHits = false;
  auto operator<=>(const ConeKernelRequest&) const = default;
};

/// The compiled shaders/trace_cone.comp for one device and request; serves any number of meshes.
class VulkanConeKernel {
 public:
  VulkanConeKernel(const Device& device, const ConeKernelRequest& request);
  /// For tests that want another shape than the device's own.
  VulkanConeKernel(const Device& device, const ConeKernelRequest& request, const VulkanWorkgroupShape& shape);

  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] const ComputePipeline& pipeline() const { return pipeline_; }
  [[nodiscard]] uint32_t rayCount() const { return request_.rayCount; }
  [[nodiscard]] bool writesHits() const { return request_.writesHits; }
  [[nodiscard]] const VulkanWorkgroupShape& shape() const { return shape_; }

 private:
  const Device& device_;
  ConeKernelRequest request_;
  VulkanWorkgroupShape shape_;
  ComputePipeline pipeline_;
};

}  // namespace asdfvk
