#pragma once

#include "poisson/scaled_system.h"
#include "poisson/vk/vulkan_system.h"

namespace asdfvk {

/// The matrix of a system on a device, for kernels that run apart from the equation of a graph.
inline VulkanMatrix matrixOn(const Device& device, const ScaledSystem& system) {
  VulkanMatrix matrix(device, system.unknownCount(), uploadVector(device, system.tailColumns()),
                      uploadVector(device, system.tailCouplings()));
  matrix.rows = uploadVector(device, system.rows());
  matrix.residualWeights = uploadVector(device, system.residualWeights());
  return matrix;
}

}  // namespace asdfvk
