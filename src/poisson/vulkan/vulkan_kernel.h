#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "vk/compute_pipeline.h"

namespace asdfvk {

/// Of vectors that kernels work on, that are set on the device and that the host reads back.
inline constexpr VkBufferUsageFlags kPoissonVectorUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// What the pipeline of a Poisson kernel with `bindingCount` bindings is made of; one with a matrix has those of
/// shaders/poisson_matrix.glsl first.
[[nodiscard]] ComputePipelineDescription describePoissonKernel(const DeviceFacts& facts, const std::string& name,
                                                               std::span<const uint32_t> spirv, uint32_t bindingCount,
                                                               bool withMatrix);

}  // namespace asdfvk
