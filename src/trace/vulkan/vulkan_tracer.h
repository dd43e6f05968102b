#pragma once

#include <memory>

#include "trace/cone_tracer.h"
#include "trace/vulkan/vulkan_cone_kernel.h"

namespace asdfvk {

/// Uploads the scene and traces on the kernel's device, in float32. Cones that the kernel gives up on, and those too
/// small for float32, are traced by the reference. The kernel, the scene and the cone must outlive the tracer; the cone
/// has the kernel's ray count. Hits may be asked for when the kernel writes them. Throws Error{Device} when the scene
/// exceeds the device's limits.
[[nodiscard]] std::unique_ptr<ConeTracer> makeVulkanTracer(const VulkanConeKernel& kernel, const TraceScene& scene,
                                                           const Cone& cone);

}  // namespace asdfvk
