#pragma once

#include "predict/vk/vulkan_prediction.h"
#include "trace/tracer_check.h"
#include "trace/vk/vulkan_cone_kernel.h"

namespace asdfvk {

// Comparisons of compiled kernels with the CPU at their first use. They have a generated mesh and a fixed cone, so that
// the outcome depends on the kernel only.

/// Compares a tracer with the reference.
[[nodiscard]] TracerCheck checkKernel(const VulkanConeKernel& kernel);
/// Compares a predictor with the prediction on the CPU, from hits of the reference.
[[nodiscard]] TracerCheck checkKernels(const VulkanPredictionKernels& kernels);

}  // namespace asdfvk
