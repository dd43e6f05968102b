#pragma once

#include <memory>

#include "trace/cone_tracer.h"
#include "trace/encoded_scene.h"
#include "trace/vk/vulkan_cone_kernel.h"

namespace asdfvk {

/// Encodes the nodes and seeds of a scene for makeVulkanTracer(), which encodes the triangles during the upload. The
/// scene must outlive the result.
[[nodiscard]] std::unique_ptr<EncodedScene> encodeForVulkan(const TraceScene& scene);

/// Uploads the scene and traces on the kernel's device, in float32. The reference traces cones that exceed the
/// iteration limit of the kernel or are too small for float32. The kernel, the scene and the cone must outlive the
/// tracer. The kernel and the cone must have the same ray count. Hits may be requested if the kernel writes them.
/// encoded: the result of encodeForVulkan() for this scene; null: this function calls it. Throws Error{DeviceLimit} if
/// the scene exceeds the limits of the device.
[[nodiscard]] std::unique_ptr<ConeTracer> makeVulkanTracer(const VulkanConeKernel& kernel, const TraceScene& scene,
                                                           const Cone& cone,
                                                           std::unique_ptr<EncodedScene> encoded = nullptr);

}  // namespace asdfvk
