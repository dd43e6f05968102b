#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "poisson/refinement.h"
#include "shared/poisson_layout.h"
#include "vk/buffer.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

/// A scaled Poisson matrix on a device, for any iteration that runs there in float32.
namespace asdfvk {

/// Size of the dispatches for one system.
struct PoissonGrid {
  uint32_t laneCount = 0;  ///< Lanes per workgroup.
  uint32_t workgroupCount = 0;
};

[[nodiscard]] PoissonGrid choosePoissonGrid(const DeviceFacts& facts, uint32_t unknownCount);

/// tailCount: number of entries beyond the third entry of their row. Throws Error{EquationLimit} if an array exceeds
/// the binding size of the device. Also throws this error if the device has DeviceFacts::endsLongLoops and a lane might
/// need too many loop iterations.
void requireSystemFits(const DeviceFacts& facts, uint64_t unknownCount, uint64_t tailCount, uint64_t longestRow);

/// Usage of vectors that kernels write and the host reads.
inline constexpr VkBufferUsageFlags kPoissonVectorUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
/// A buffer of float32 with unspecified entries.
[[nodiscard]] Buffer makePoissonVector(const Device& device, uint64_t count);
[[nodiscard]] std::vector<float> downloadPoissonVector(const Device& device, const Buffer& vector, size_t count);

/// Records a command that copies `sums` to `onHost`, a HostVisible buffer. Submits the commands, waits, and returns the
/// sums.
[[nodiscard]] PoissonSums submitAndRead(CommandList& commands, const Buffer& sums, const Buffer& onHost);
/// The square root of the sum of `ofWorkgroups`, one of the arrays of PoissonSums, over the workgroups of the grid.
[[nodiscard]] double rootOfSum(std::span<const float> ofWorkgroups, const PoissonGrid& grid);

/// uploadBuffer() of a vector.
template <typename Vector>
[[nodiscard]] Buffer uploadVector(const Device& device, const Vector& vector,
                                  VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) {
  return uploadBuffer(device, std::as_bytes(std::span(vector)), usage);
}

/// The pipeline of a Poisson kernel.
[[nodiscard]] ComputePipelineDescription describePoissonKernel(const DeviceFacts& facts, const std::string& name,
                                                               std::span<const uint32_t> spirv, uint32_t bindingCount);

/// The matrix on the device, bindings 0 to 2 of shaders/poisson/matrix.glsl, and the residual weights.
struct VulkanMatrix {
  /// A matrix with unspecified rows and residual weights, for kernels that write them. Precondition:
  /// requireSystemFits().
  VulkanMatrix(const Device& device, uint32_t rowCount, Buffer tailColumns, Buffer tailCouplings);

  uint32_t rowCount;
  PoissonGrid grid;
  Buffer rows, tailColumns, tailCouplings;
  /// Weight 0 excludes a row and its column: the unknown stays 0. Precondition: the right-hand side of such a row is 0.
  Buffer residualWeights;
};

/// A reduction of the residual by an iteration in float32.
struct DevicePass {
  const VulkanMatrix& matrix;
  const Buffer& rightHandSide;  ///< #U, of weighted norm 1. The vector represents a residual of norm `norm`.
  double norm;
  double reduction;  ///< The pass may end when the norm is at or below this share of `norm`.
  uint32_t maxIterations;
  SolverProgress& progress;
};

struct DevicePassResult {
  Buffer solution;  ///< #U
  uint32_t iterationCount = 0;
};

}  // namespace asdfvk
