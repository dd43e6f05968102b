#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "trace/vulkan/vulkan_trace_choice.h"
#include "trace/vulkan/vulkan_workgroup_shape.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// What a kernel is compiled for.
struct ConeKernelRequest {
  uint32_t rayCount;
  bool writesHits = false;
  std::optional<VulkanTraceChoice> choice = {};  ///< None: defaultTraceChoice().
  auto operator<=>(const ConeKernelRequest&) const = default;
};

/// The compiled shaders/trace_*.comp for one device and request; serves any number of meshes.
class VulkanConeKernel {
 public:
  VulkanConeKernel(const Device& device, const ConeKernelRequest& request);
  /// For tests that want another shape than the device's own.
  VulkanConeKernel(const Device& device, const ConeKernelRequest& request, const VulkanWorkgroupShape& shape);

  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] const VulkanTraceChoice& choice() const { return choice_; }
  /// Binds nodes and triangles (texels, then storage), rays, origins, results or lengths, hits.
  [[nodiscard]] const ComputePipeline& pipeline() const { return pipeline_; }
  /// Of a kernel that leaves lengths, one per ray and cone: what makes results of them. Binds rays, lengths, results.
  [[nodiscard]] const ComputePipeline* reduction() const { return reduction_ ? &*reduction_ : nullptr; }
  [[nodiscard]] uint32_t rayCount() const { return request_.rayCount; }
  [[nodiscard]] bool writesHits() const { return request_.writesHits; }
  [[nodiscard]] const VulkanWorkgroupShape& shape() const { return shape_; }
  static constexpr uint32_t kReductionLaneCount = 64;

 private:
  const Device& device_;
  ConeKernelRequest request_;
  VulkanTraceChoice choice_;
  VulkanWorkgroupShape shape_;
  ComputePipeline pipeline_;
  std::optional<ComputePipeline> reduction_;
};

}  // namespace asdfvk
