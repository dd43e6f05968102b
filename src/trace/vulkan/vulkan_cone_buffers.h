#pragma once

#include <cstdint>
#include <optional>

#include "bvh/device_bvh.h"
#include "cone/cone.h"
#include "shared/cone_layout.h"
#include "trace/vulkan/vulkan_cone_kernel.h"

namespace asdfvk {

/// As many cones as the kernel may be given at once, so that their buffers stay within the device's limits and modest.
[[nodiscard]] uint64_t largestConeChunk(const VulkanConeKernel& kernel);

/// A scene and a cone on the kernel's device, and room for one chunk of cones; all that the kernel binds.
struct ConeBuffers {
  /// Throws Error{Device} when the scene exceeds the device's limits.
  ConeBuffers(const VulkanConeKernel& kernel, const DeviceBvh& bvh, const Cone& cone);

  Buffer nodes, triangles, rays;
  Buffer origins;  ///< Mapped: a ConeOrigin per cone.
  Buffer lengths;  ///< Bits of a float per ray and cone, if the kernel leaves them.
  Buffer results;  ///< Mapped: a uint32_t per cone, see shared/cone_layout.h.
  Buffer hits;     ///< Mapped: a ConeHit per cone and ray, if the kernel writes them.

 private:
  Buffer nothing_;  // What the way of fetching that is not chosen binds.
  TexelView nodeTexels_, triangleTexels_, rayTexels_, originTexels_;

 public:
  BindingSet bindings;
  std::optional<BindingSet> reductionBindings;
};

[[nodiscard]] inline glsl::vec3 toGlsl(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace asdfvk
