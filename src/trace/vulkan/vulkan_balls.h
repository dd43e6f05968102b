#pragma once

#include <memory>

#include "trace/ball_shrinker.h"
#include "trace/vulkan/vulkan_cone_kernel.h"

namespace asdfvk {

/// Finds the walls by shaders/shrink_ball.comp in float32; diameters are computed in double from the walls. The
/// reference shrinks balls that exceed the iteration limit of the kernel or are too small for float32. The kernel,
/// which shrinks balls, and the buffers must outlive it.
[[nodiscard]] std::unique_ptr<BallShrinker> makeVulkanBallShrinker(const VulkanConeKernel& kernel,
                                                                   const ConeBuffers& buffers, const TraceScene& scene,
                                                                   const OpposingWalls& walls);

}  // namespace asdfvk
