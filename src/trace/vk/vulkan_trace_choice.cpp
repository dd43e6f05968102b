#include "trace/vk/vulkan_trace_choice.h"

#include <algorithm>

#include "bvh/device_bvh.h"

namespace asdfvk {
namespace {

uint32_t roundUp(uint32_t value, uint32_t multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device) {
  const bool readsTexels = device.isCpu() && prefersTexels(device);
  return {TraceKernel::Seed, readsTexels ? BvhFetch::Texel : BvhFetch::Storage};
}

VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const TraceVariant& request) {
  const VulkanTraceChoice best = defaultTraceChoice(device);
  return {request.kernel.value_or(best.kernel), request.fetch.value_or(best.fetch)};
}

VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const TraceVariant& request, const Bvh& bvh) {
  VulkanTraceChoice choice = traceChoiceFor(device, request);
  const uint64_t blockCount = maxBlockCount(bvh);
  const auto fits = [&](BvhFetch fetch) {
    return fetch == BvhFetch::Texel ? blockCount <= device.maxTexelBufferElements
                                    : blockCount <= device.maxStorageBufferRange / kDeviceBlockByteCount;
  };
  const BvhFetch other = choice.fetch == BvhFetch::Texel ? BvhFetch::Storage : BvhFetch::Texel;
  if (!request.fetch && !fits(choice.fetch) && fits(other)) choice.fetch = other;
  return choice;
}

VulkanWorkgroupShape workgroupShapeFor(const DeviceFacts& device, uint32_t rayCount, TraceKernel kernel) {
  const auto atMost = [&](uint32_t laneCount) {
    return std::min({laneCount, device.maxWorkgroupInvocations, device.maxWorkgroupSize});
  };
  const bool isCpu = device.isCpu();
  VulkanWorkgroupShape shape;
  if (kernel == TraceKernel::Seed) {
    shape.lanesPerCone = 1;
    shape.conesPerWorkgroup = atMost(64);
  } else {
    shape.lanesPerCone = std::min(atMost(256), roundUp(rayCount, isCpu ? 8 : std::clamp(device.subgroupSize, 8u, 32u)));
    if (!isCpu) shape.conesPerWorkgroup = std::max(1u, atMost(128) / shape.lanesPerCone);
  }
  // The limit applies to the sum over the lanes of a subgroup. The lanes of a packet run every loop together.
  constexpr uint32_t kPacketMargin = 64;  // An iteration of a packet adds less than this to the count.
  if (device.endsLongLoops)
    shape.iterationLimit = kernel == TraceKernel::Packet ? kMaxLoopIterationCount - kPacketMargin
                                                         : kMaxLoopIterationCount / std::max(1u, device.subgroupSize);
  return shape;
}

VulkanWalkShape walkShapeFor(const DeviceFacts& device) {
  constexpr uint32_t kLongStack = 65;  // In words of 4 bytes; the stack is larger than 256 bytes.
  static_assert(kLongStack >= kMaxBvhDepth);
  // 1.5 million faces have 8 levels below the root, and need 8 entries at most. Each level more has about five times as
  // many faces.
  constexpr uint32_t kShortStack = 16;
  constexpr uint32_t kSmallAmdSubgroup = 32;
  VulkanWalkShape shape;
  if (device.isCpu()) return shape;
  const bool isAmd = device.vendor == DeviceVendor::Amd;
  shape.stackSize = isAmd ? kLongStack : kShortStack;
  shape.arithmetic = isAmd ? NodeArithmetic::ShiftedBytes : NodeArithmetic::MantissaBytes;
  if (isAmd && canRequireSubgroupSize(device, kSmallAmdSubgroup)) shape.subgroupSize = kSmallAmdSubgroup;
  return shape;
}

}  // namespace asdfvk
