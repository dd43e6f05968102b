#pragma once

#include "predict/vulkan/vulkan_prediction.h"
#include "trace/tracer_check.h"
#include "trace/vulkan/vulkan_cone_kernel.h"

namespace asdfvk {

// Comparisons of compiled kernels with the CPU at their first use, on a
// generated mesh and with a cone of their own, so that the outcome depends on
// nothing but the kernel.

/// Compares a tracer with the reference.
[[nodiscard]] TracerCheck checkKernel(const VulkanConeKernel& kernel);
/// Compares a predictor with the prediction on the CPU, from hits of the reference.
[[nodiscard]] TracerCheck checkKernels(const VulkanPredictionKernels& kernels);

}  // namespace asdfvk
