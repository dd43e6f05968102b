#pragma once

#include <span>

#include "poisson/scaled_system.h"
#include "poisson/vulkan/vulkan_system.h"

namespace asdfvk {

/// The matrix of a system on a device, for kernels that run apart from the equation of a graph.
inline VulkanMatrix matrixOn(const Device& device, const ScaledSystem& system) {
  VulkanMatrix matrix(device, system.unknownCount(), uploadVector(device, system.tailColumns()),
                      uploadVector(device, system.tailCouplings()));
  const bool asTexels = prefersTexels(device.facts());
  const std::span<const std::byte> rows = std::as_bytes(std::span(system.rows())), none;
  matrix.texelRows = uploadBuffer(device, asTexels ? rows : none, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
  matrix.rowTexels = TexelView(device, matrix.texelRows);
  matrix.storageRows = uploadBuffer(device, asTexels ? none : rows, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  matrix.residualWeights = uploadVector(device, system.residualWeights());
  return matrix;
}

}  // namespace asdfvk
