#include "poisson/vk/vulkan_system.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "asdf_vk/error.h"
#include "shared/poisson_layout.h"
#include "shared/specialization_ids.h"

namespace asdfvk {
namespace {

// Every workgroup adds up the partial sums of all workgroups. This must be little work compared with the work on the
// rows of the workgroup. A GPU needs many lanes, and adds 256 sums in one step; neither is true for a CPU device.
constexpr uint32_t kGpuLaneCount = 256, kGpuRowsPerLane = 4;
constexpr uint32_t kCpuLaneCount = 32, kCpuRowsPerLane = 32;
// A tenth of the limit is a margin for loops that the compiler adds.
constexpr uint64_t kMaxKernelIterationCount = kMaxLoopIterationCount / 10 * 9;

uint32_t minRowsPerLane(const DeviceFacts& facts) { return facts.isCpu() ? kCpuRowsPerLane : kGpuRowsPerLane; }

uint64_t divideUp(uint64_t dividend, uint64_t divisor) { return (dividend + divisor - 1) / divisor; }

/// Lanes per workgroup on this device: kLaneCount in the shaders.
uint32_t laneCountOn(const DeviceFacts& facts) {
  const uint32_t wanted = facts.isCpu() ? kCpuLaneCount : kGpuLaneCount;
  return std::bit_floor(std::min({wanted, facts.maxWorkgroupInvocations, facts.maxWorkgroupSize}));
}

}  // namespace

PoissonGrid choosePoissonGrid(const DeviceFacts& facts, uint32_t unknownCount) {
  const uint32_t laneCount = laneCountOn(facts);
  const uint64_t wanted = divideUp(unknownCount, uint64_t{laneCount} * minRowsPerLane(facts));
  return {laneCount, static_cast<uint32_t>(std::clamp<uint64_t>(wanted, 1, kMaxPoissonWorkgroupCount))};
}

void requireSystemFits(const DeviceFacts& facts, uint64_t unknownCount, uint64_t tailCount, uint64_t longestRow) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::EquationLimit, fmt::format("the Poisson system of {} unknowns exceeds a limit of {}: {}",
                                                      unknownCount, facts.name, reason));
  };
  const uint64_t byteCount = std::max(sizeof(uint32_t) * tailCount, sizeof(PoissonRow) * unknownCount);
  if (byteCount > facts.maxStorageBufferRange)
    refuse(fmt::format("{} MiB in one buffer, at most {}", (byteCount >> 20) + 1, facts.maxStorageBufferRange >> 20));
  const uint64_t laneCount = laneCountOn(facts);
  const uint64_t rowsPerLane = divideUp(unknownCount, laneCount * kMaxPoissonWorkgroupCount);
  // Iterations of the loops of a kernel: rows and their entries, partial sums, two reduction trees.
  const uint64_t iterationCount = std::max<uint64_t>(rowsPerLane, minRowsPerLane(facts)) * (longestRow + 1) +
                                  divideUp(kMaxPoissonWorkgroupCount, laneCount) + 2u * std::bit_width(laneCount);
  if (facts.endsLongLoops && iterationCount > kMaxKernelIterationCount)
    refuse(fmt::format("{} loop iterations of a lane (rows have up to {} entries), at most {}", iterationCount,
                       longestRow, kMaxKernelIterationCount));
}

ComputePipelineDescription describePoissonKernel(const DeviceFacts& facts, const std::string& name,
                                                 std::span<const uint32_t> spirv, uint32_t bindingCount) {
  return {name,
          spirv,
          std::vector(bindingCount, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
          sizeof(PoissonPush),
          {{kLocalSizeXId, laneCountOn(facts)}, {kLaneCountId, laneCountOn(facts)}}};
}

VulkanMatrix::VulkanMatrix(const Device& device, uint32_t count, Buffer columns, Buffer couplings)
    : rowCount(count),
      grid(choosePoissonGrid(device.facts(), rowCount)),
      rows(device, rowCount * sizeof(PoissonRow), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::DeviceLocal),
      tailColumns(std::move(columns)),
      tailCouplings(std::move(couplings)),
      residualWeights(makePoissonVector(device, rowCount)) {}

Buffer makePoissonVector(const Device& device, uint64_t count) {
  return {device, std::max<uint64_t>(count, 1) * sizeof(float), kPoissonVectorUsage, MemoryKind::DeviceLocal};
}

std::vector<float> downloadPoissonVector(const Device& device, const Buffer& vector, size_t count) {
  std::vector<float> values(count);
  downloadBuffer(device, vector, std::as_writable_bytes(std::span(values)));
  return values;
}

PoissonSums submitAndRead(CommandList& commands, const Buffer& sums, const Buffer& onHost) {
  commands.copy(sums, 0, onHost, 0, sizeof(PoissonSums));
  commands.barrier();
  commands.submitAndWait();
  PoissonSums read;
  std::memcpy(&read, onHost.mapped(), sizeof read);
  return read;
}

double rootOfSum(std::span<const float> ofWorkgroups, const PoissonGrid& grid) {
  double sum = 0;
  for (const float each : ofWorkgroups.first(grid.workgroupCount)) sum += static_cast<double>(each);
  return std::sqrt(sum);
}

}  // namespace asdfvk
