#pragma once

#include <span>
#include <vector>

#include "smooth/bilateral.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// The kernel of a smoothing pass, made once per device: shaders/bilateral.comp.
struct VulkanBilateralKernel {
  explicit VulkanBilateralKernel(const Device& device);

  ComputePipeline pass;
};

/// smoothBilaterally() on the kernel's device, in float32: all passes in one submission. Results differ from the CPU's
/// by the rounding of float32, about 1e-7 of the largest value. The same bits each time on one device. Throws
/// Error{Usage} for a window out of range, Error{Device} when the mesh exceeds the device's limits.
[[nodiscard]] std::vector<double> smoothBilaterallyOnDevice(const Device& device, const VulkanBilateralKernel& kernel,
                                                            const DualGraph& graph, std::span<const double> values,
                                                            const BilateralOptions& options);

}  // namespace asdfvk
