#include "poisson/vulkan/vulkan_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "asdf_vk/error.h"
#include "shared/poisson_layout.h"

namespace asdfvk {
namespace {

// Every workgroup adds all the partial sums up again, so rows per lane must pay for it. A GPU has lanes to fill and
// adds 256 sums at a stroke; a CPU device has neither.
constexpr uint32_t kGpuLaneCount = 256, kGpuRowsPerLane = 4;
constexpr uint32_t kCpuLaneCount = 32, kCpuRowsPerLane = 32;
// With room for what the compiler makes of the loops.
constexpr uint64_t kLoopIterationLimit = kCpuDeviceLoopIterationCount / 10 * 9;

uint32_t rowsPerLaneAtLeast(const DeviceFacts& facts) {
  return facts.kind == DeviceKind::Cpu ? kCpuRowsPerLane : kGpuRowsPerLane;
}

uint64_t divideUp(uint64_t dividend, uint64_t divisor) { return (dividend + divisor - 1) / divisor; }

template <typename T>
Buffer uploadArray(const Device& device, const UnsetVector<T>& array, VkBufferUsageFlags usage) {
  return uploadBuffer(device, std::as_bytes(std::span(array)), usage);
}

}  // namespace

uint32_t poissonLaneCount(const DeviceFacts& facts) {
  const uint32_t wanted = facts.kind == DeviceKind::Cpu ? kCpuLaneCount : kGpuLaneCount;
  return std::bit_floor(std::min({wanted, facts.maxWorkgroupInvocations, facts.maxWorkgroupSize}));
}

PoissonGrid choosePoissonGrid(const DeviceFacts& facts, uint32_t unknownCount) {
  const uint32_t laneCount = poissonLaneCount(facts);
  const uint64_t wanted = divideUp(unknownCount, uint64_t{laneCount} * rowsPerLaneAtLeast(facts));
  return {laneCount, static_cast<uint32_t>(std::clamp<uint64_t>(wanted, 1, kMaxPoissonWorkgroupCount))};
}

void requireSystemFits(const DeviceFacts& facts, uint64_t unknownCount, uint64_t tailCount, uint64_t longestRow) {
  if (unknownCount * kPoissonRowTexelCount > facts.maxTexelBufferElements)
    throw Error(
        ErrorCode::EquationLimit,
        fmt::format("the Poisson system of {} unknowns needs {} texels in one buffer and {} "
                    "allows {}; use --solver cpu",
                    unknownCount, unknownCount * kPoissonRowTexelCount, facts.name, facts.maxTexelBufferElements));
  const uint64_t byteCount = sizeof(uint32_t) * std::max(unknownCount, tailCount);
  if (byteCount > facts.maxStorageBufferRange)
    throw Error(ErrorCode::EquationLimit,
                fmt::format("the Poisson system of {} unknowns needs {} MiB in one buffer and {} allows {}; "
                            "use --solver cpu",
                            unknownCount, (byteCount >> 20) + 1, facts.name, facts.maxStorageBufferRange >> 20));
  const uint64_t laneCount = poissonLaneCount(facts);
  const uint64_t rowsPerLane = divideUp(unknownCount, laneCount * kMaxPoissonWorkgroupCount);
  // The loops of a kernel: rows and their entries, partial sums, two reduction trees.
  const uint64_t iterations = std::max<uint64_t>(rowsPerLane, rowsPerLaneAtLeast(facts)) * (longestRow + 1) +
                              divideUp(kMaxPoissonWorkgroupCount, laneCount) + 2u * std::bit_width(laneCount);
  if (iterations > kLoopIterationLimit)
    throw Error(ErrorCode::EquationLimit,
                fmt::format("the Poisson system of {} unknowns, {} of them in one row, is too much for one kernel; "
                            "use --solver cpu",
                            unknownCount, longestRow));
}

VulkanMatrix::VulkanMatrix(const Device& device, const ScaledSystem& system) {
  requireSystemFits(device.facts(), system.unknownCount(), system.tailColumns().size(), system.longestRow());
  grid = choosePoissonGrid(device.facts(), system.unknownCount());
  rows = uploadArray(device, system.rows(), VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
  rowTexels = TexelView(device, rows);
  tailColumns = uploadArray(device, system.tailColumns(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  tailCouplings = uploadArray(device, system.tailCouplings(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  residualWeights = uploadArray(device, system.residualWeights(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

}  // namespace asdfvk
