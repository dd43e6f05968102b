#pragma once

#include <cstdint>
#include <vector>

#include "poisson/scaled_system.h"
#include "vk/buffer.h"
#include "vk/device.h"

namespace asdfvk {

/// How many lanes in how many workgroups work on a system; both kernels and host need it.
struct PoissonGrid {
  uint32_t laneCount = 0;  ///< Of a workgroup.
  uint32_t workgroupCount = 0;
};

/// The lanes of a workgroup on this device: what pipelines are specialized for.
[[nodiscard]] uint32_t poissonLaneCount(const DeviceFacts& facts);
[[nodiscard]] PoissonGrid choosePoissonGrid(const DeviceFacts& facts, uint32_t unknownCount);

/// tailCount: entries beyond the third of their row. Throws Error{Device}, naming --solver cpu as the remedy, when an
/// array is larger than a binding may be on the device, or a lane might need more loop iterations than Mesa's CPU
/// device executes before it ends loops silently.
void requireSystemFits(const DeviceFacts& facts, uint64_t unknownCount, uint64_t tailCount, uint64_t longestRow);

/// The matrix on the device: bindings 0 to 2 of shaders/poisson_matrix.glsl, and the weights of residuals.
struct VulkanMatrix {
  /// Throws as requireSystemFits().
  VulkanMatrix(const Device& device, const ScaledSystem& system);

  PoissonGrid grid;
  Buffer rows;
  TexelView rowTexels;
  Buffer tailColumns, tailCouplings, residualWeights;
};

}  // namespace asdfvk
