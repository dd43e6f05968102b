#include "trace/vulkan/vulkan_workgroup_shape.h"

#include <algorithm>

namespace asdfvk {
namespace {

// One ray per lane.
VulkanWorkgroupShape seedShape(const DeviceFacts& device) {
  VulkanWorkgroupShape shape{1, std::min({64u, device.maxWorkgroupInvocations, device.maxWorkgroupSize})};
  if (device.kind == DeviceKind::Cpu)
    shape.iterationLimit = kCpuDeviceLoopIterationCount / std::max(1u, device.subgroupSize);
  return shape;
}

uint32_t roundUp(uint32_t value, uint32_t multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

VulkanWorkgroupShape workgroupShapeFor(const DeviceFacts& device, uint32_t rayCount, TraceKernel kernel) {
  if (kernel == TraceKernel::Seed) return seedShape(device);
  VulkanWorkgroupShape shape;
  const uint32_t widest = std::min({256u, device.maxWorkgroupInvocations, device.maxWorkgroupSize});
  if (device.kind != DeviceKind::Cpu) {
    shape.lanesPerCone = std::min(widest, roundUp(rayCount, std::clamp(device.subgroupSize, 8u, 32u)));
    shape.conesPerWorkgroup = std::max(1u, std::min(128u, device.maxWorkgroupInvocations) / shape.lanesPerCone);
    return shape;
  }
  shape.lanesPerCone = std::min(widest, roundUp(rayCount, 8));
  // What the reduction needs: three walks over all rays, and one over all of them for each ray of the lane.
  const uint32_t raysPerLane = (rayCount + shape.lanesPerCone - 1) / shape.lanesPerCone;
  const uint32_t reductionCount = rayCount * (3 + raysPerLane) + 2 * raysPerLane + 64;
  // The lanes of a packet run every loop together; of other kernels each may run its own.
  const uint32_t sharingCount = kernel == TraceKernel::Packet ? 1 : std::max(1u, device.subgroupSize);
  shape.iterationLimit = (kCpuDeviceLoopIterationCount - reductionCount) / sharingCount;
  return shape;
}

}  // namespace asdfvk
