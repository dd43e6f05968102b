#pragma once

#include <compare>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "bvh/wide_bvh.h"
#include "cone/cone.h"
#include "shared/cone_layout.h"
#include "trace/trace_scene.h"
#include "trace/vk/vulkan_trace_choice.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// Parameters for which a kernel is compiled.
struct ConeKernelRequest {
  uint32_t rayCount;
  bool writesHits = false;
  std::optional<VulkanTraceChoice> choice = {};  ///< Unset: defaultTraceChoice().
  Definition definition = Definition::Paper;
  auto operator<=>(const ConeKernelRequest&) const = default;
};

[[nodiscard]] ComputePipelineDescription describeRays(const ConeKernelRequest& request, const VulkanTraceChoice& choice,
                                                      const VulkanWorkgroupShape& shape, const VulkanWalkShape& walk);

/// The compiled shaders/trace/*.comp for one device and one request, for any number of meshes.
class VulkanConeKernel {
 public:
  /// shape, walk: given by tests; otherwise those for the device.
  VulkanConeKernel(const Device& device, const ConeKernelRequest& request,
                   const std::optional<VulkanWorkgroupShape>& shape = {},
                   const std::optional<VulkanWalkShape>& walk = {});

  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] const VulkanTraceChoice& choice() const { return choice_; }
  /// Traces rays in a hierarchy with `depth` levels below the root (WideBvh::depth). The stack of a lane holds at most
  /// one entry per level: the siblings of a node that the ray also enters. Therefore it cannot overflow. Bindings:
  /// nodes and triangles (as texels, then as storage), rays, origins, lengths, hits. Thread-safe.
  [[nodiscard]] const ComputePipeline& rays(uint32_t depth) const;
  /// Computes the starts of cones from their seeds. Null for Definition::Cgal, because its frames depend on corners in
  /// double precision. Bindings: nodes and triangles like rays(depth), seeds, starts.
  [[nodiscard]] const ComputePipeline* origins() const { return origins_ ? &*origins_ : nullptr; }
  /// Computes results from lengths. Bindings: rays, lengths, results.
  [[nodiscard]] const ComputePipeline& reduction() const { return reduction_; }
  [[nodiscard]] uint32_t rayCount() const { return request_.rayCount; }
  [[nodiscard]] Definition definition() const { return request_.definition; }
  [[nodiscard]] bool writesHits() const { return request_.writesHits; }
  [[nodiscard]] const VulkanWorkgroupShape& shape() const { return shape_; }
  static constexpr uint32_t kOriginLaneCount = 64, kReductionLaneCount = 64;

 private:
  const Device& device_;
  ConeKernelRequest request_;
  VulkanTraceChoice choice_;
  VulkanWorkgroupShape shape_;
  VulkanWalkShape walk_;
  ComputePipeline rays_, reduction_;
  std::optional<ComputePipeline> origins_;
  mutable std::once_flag isDeepMade_;
  mutable std::optional<ComputePipeline> deepRays_;  // For hierarchies of more levels than the stack of rays_ has.
};

/// Largest number of cones of one dispatch. Buffers are within the limits of the device and at most 32 MiB each.
[[nodiscard]] uint64_t largestConeChunk(const VulkanConeKernel& kernel);

/// A scene and a cone on the device of a kernel.
class ConeBuffers {
 public:
  /// Throws Error{DeviceLimit} if the scene exceeds the limits of the device.
  ConeBuffers(const VulkanConeKernel& kernel, const TraceScene& scene, const WideBvh& wide, const Cone& cone);

  /// The first bindings of every traversal kernel: nodes and triangles as texels, then as storage.
  [[nodiscard]] std::vector<Binding> hierarchyBindings() const;
  [[nodiscard]] const TexelView& rayTexels() const { return rayTexels_; }
  [[nodiscard]] uint32_t hierarchyDepth() const { return hierarchyDepth_; }  ///< WideBvh::depth
  /// A buffer for bindings that a kernel does not access.
  [[nodiscard]] const Buffer& nothing() const { return nothing_; }

 private:
  bool fetchesTexels_;
  uint32_t hierarchyDepth_;
  Buffer nodes_, triangles_, rays_;
  Buffer nothing_;
  TexelView nodeTexels_, triangleTexels_, rayTexels_;
};

[[nodiscard]] inline glsl::vec3 toGlsl(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace asdfvk
