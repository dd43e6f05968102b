// The choice of kernel, fetch and shapes for a device, and devices that cannot run a kernel.
#include "trace/vk/vulkan_trace_choice.h"

#include <doctest/doctest.h>

#include <optional>

#include "asdf_vk/error.h"
#include "bvh/device_bvh.h"
#include "generate/shapes.h"
#include "spirv/trace_packet.comp.h"
#include "spirv/trace_rays.comp.h"
#include "spirv/trace_reduce.comp.h"
#include "support/require_failure.h"
#include "support/specialization_ids.h"
#include "support/test_device.h"
#include "trace/vk/vulkan_tracer.h"
#include "traced_mesh.h"

using namespace asdfvk;

TEST_CASE("the walk has the stack and the arithmetic of the class of the device, and postpones triangles") {
  const auto shapeOf = [](DeviceKind kind, DeviceVendor vendor) {
    DeviceFacts facts;
    facts.kind = kind;
    facts.vendor = vendor;
    return walkShapeFor(facts);
  };
  const VulkanWalkShape amd = shapeOf(DeviceKind::Integrated, DeviceVendor::Amd);
  CHECK(amd.stackSize > 64);
  CHECK(amd.postponesTriangles);
  const VulkanWalkShape cpu = shapeOf(DeviceKind::Cpu, DeviceVendor::Other),
                        nvidia = shapeOf(DeviceKind::Discrete, DeviceVendor::Nvidia);
  CHECK(cpu.stackSize == kMaxBvhDepth);  // A second pipeline would take longer to compile.
  CHECK(nvidia.stackSize == 16);
  CHECK(cpu.postponesTriangles);
  CHECK(nvidia.postponesTriangles);
  CHECK(amd.arithmetic == NodeArithmetic::ShiftedBytes);
  CHECK(cpu.arithmetic == NodeArithmetic::MaskedBytes);
  CHECK(nvidia.arithmetic == NodeArithmetic::MantissaBytes);
}

TEST_CASE("AMD GPUs run subgroups of 32 lanes where a kernel can require them") {
  DeviceFacts facts;
  facts.kind = DeviceKind::Discrete;
  facts.subgroupSize = 64;
  const auto sizeOn = [&](DeviceVendor vendor, uint32_t least, uint32_t greatest) {
    facts.vendor = vendor;
    facts.minRequiredSubgroupSize = least;
    facts.maxRequiredSubgroupSize = greatest;
    const VulkanTraceChoice choice = defaultTraceChoice(facts);
    return describeRays({30}, choice, workgroupShapeFor(facts, 30, choice.kernel), walkShapeFor(facts))
        .requiredSubgroupSize;
  };
  CHECK(sizeOn(DeviceVendor::Amd, 32, 64) == 32);
  CHECK(sizeOn(DeviceVendor::Amd, 64, 64) == 0);  // GCN
  CHECK(sizeOn(DeviceVendor::Amd, 0, 0) == 0);
  CHECK(sizeOn(DeviceVendor::Nvidia, 32, 32) == 0);
  CHECK(sizeOn(DeviceVendor::Intel, 8, 32) == 0);
  facts.kind = DeviceKind::Cpu;
  CHECK(sizeOn(DeviceVendor::Amd, 8, 32) == 0);
}

TEST_CASE("the device's own iteration guard suffices for its workgroup shape") {
  // llvmpipe would end loops without a word at 65,535 iterations: the shape must stop before.
  DeviceFacts cpu;
  cpu.kind = DeviceKind::Cpu;
  cpu.endsLongLoops = true;
  cpu.subgroupSize = 8;
  cpu.maxWorkgroupInvocations = 1024;
  cpu.maxWorkgroupSize = 1024;
  for (uint32_t rayCount = 1; rayCount <= kMaxRayCount; ++rayCount) {
    const VulkanWorkgroupShape rays = workgroupShapeFor(cpu, rayCount, TraceKernel::Ray);
    REQUIRE(8ull * rays.iterationLimit <= 65'535);
    REQUIRE(rays.lanesPerCone % 8 == 0);
    const VulkanWorkgroupShape seeds = workgroupShapeFor(cpu, rayCount, TraceKernel::Seed);
    REQUIRE(8ull * seeds.iterationLimit <= 65'535);
    REQUIRE(seeds.lanesPerCone * seeds.conesPerWorkgroup % 8 == 0);
    // An iteration of a packet counts 2 and a triangle of each of eight leaves.
    REQUIRE(workgroupShapeFor(cpu, rayCount, TraceKernel::Packet).iterationLimit + 2 + 24 <= 65'535);
    // The iterations of the loops of trace_reduce.comp, by either definition.
    REQUIRE(31ull * rayCount + 5 * rayCount + 31 + 17 * rayCount + 16 <= 65'535);
    DeviceFacts gpu = cpu;
    gpu.kind = DeviceKind::Discrete;
    REQUIRE(8ull * workgroupShapeFor(gpu, rayCount, TraceKernel::Ray).iterationLimit <= 65'535);
  }
}

TEST_CASE("a GPU's workgroups hold several cones") {
  DeviceFacts gpu;
  gpu.kind = DeviceKind::Discrete;
  gpu.subgroupSize = 32;
  gpu.maxWorkgroupInvocations = 1024;
  gpu.maxWorkgroupSize = 1024;
  CHECK(workgroupShapeFor(gpu, 30, TraceKernel::Ray).lanesPerCone == 32);
  CHECK(workgroupShapeFor(gpu, 30, TraceKernel::Ray).conesPerWorkgroup == 4);
  CHECK(workgroupShapeFor(gpu, 1024, TraceKernel::Ray).lanesPerCone == 256);
  CHECK(workgroupShapeFor(gpu, 1024, TraceKernel::Ray).conesPerWorkgroup == 1);
  gpu.maxWorkgroupInvocations = gpu.maxWorkgroupSize = 128;  // the least that Vulkan allows
  CHECK(workgroupShapeFor(gpu, 1024, TraceKernel::Ray).lanesPerCone == 128);
}

TEST_CASE("the kernel is chosen by the class of the device, or as requested") {
  DeviceFacts facts;
  facts.subgroupSize = 8;
  facts.kind = DeviceKind::Cpu;
  CHECK(defaultTraceChoice(facts).kernel == TraceKernel::Seed);
  facts.maxTexelBufferElements = 1u << 27;
  facts.maxStorageBufferRange = 1u << 27;
  CHECK(defaultTraceChoice(facts).fetch == BvhFetch::Texel);
  facts.maxTexelBufferElements = 65'536;
  CHECK(defaultTraceChoice(facts).fetch == BvhFetch::Storage);
  facts.kind = DeviceKind::Discrete;
  facts.maxTexelBufferElements = 1u << 27;
  for (const uint32_t size : {8u, 32u, 64u}) {
    facts.subgroupSize = size;
    CHECK(defaultTraceChoice(facts).fetch == BvhFetch::Storage);
    const VulkanTraceChoice best = defaultTraceChoice(facts);
    CHECK(best.kernel == TraceKernel::Seed);
    CHECK(traceChoiceFor(facts, {.kernel = TraceKernel::Ray}) == VulkanTraceChoice{TraceKernel::Ray, best.fetch});
    CHECK(traceChoiceFor(facts, {}) == best);
    CHECK(traceChoiceFor(facts, {.fetch = BvhFetch::Storage}) == VulkanTraceChoice{best.kernel, BvhFetch::Storage});
    CHECK(traceChoiceFor(facts, {.fetch = BvhFetch::Texel}).fetch == BvhFetch::Texel);
  }
  const test::ValidatedDevice device;
  CHECK(VulkanConeKernel(*device, {30}).choice() == defaultTraceChoice(device->facts()));
  const VulkanTraceChoice packet{TraceKernel::Packet, BvhFetch::Storage};
  CHECK(VulkanConeKernel(*device, {30, false, packet}).choice() == packet);
}

TEST_CASE("each specialization constant of the tracing shaders has an id of its own") {
  CHECK(test::hasDistinctSpecializationIds(k_trace_packet_comp));
  CHECK(test::hasDistinctSpecializationIds(k_trace_rays_comp));
  CHECK(test::hasDistinctSpecializationIds(k_trace_reduce_comp));
}

TEST_CASE("a device that does not end long loops has no iteration guard of its own") {
  DeviceFacts cpu;
  cpu.kind = DeviceKind::Cpu;
  cpu.subgroupSize = 8;
  cpu.maxWorkgroupInvocations = cpu.maxWorkgroupSize = 1024;
  for (const TraceKernel kernel : {TraceKernel::Packet, TraceKernel::Ray, TraceKernel::Seed})
    CHECK(workgroupShapeFor(cpu, 1024, kernel).iterationLimit == VulkanWorkgroupShape{}.iterationLimit);
}

TEST_CASE("a hierarchy that exceeds the limit of one fetch is read by the other, unless a fetch is requested") {
  const TracedMesh traced(generateShape("torus", 2000).mesh);
  const uint64_t blockCount = maxBlockCount(traced.scene().bvh);
  const WideBvh encoded = encodeWideBvh(traced.scene().bvh);
  CHECK(encoded.nodes.size() * sizeof(DeviceWideNode) <= 16 * blockCount);
  CHECK(encoded.primitiveFaces.size() * sizeof(DeviceTriangle) <= 16 * blockCount);
  CHECK(blockCount <= 6 * encoded.primitiveFaces.size());

  DeviceFacts facts;
  const auto fetchWith = [&](uint64_t texelCount, uint64_t storageByteCount, std::optional<BvhFetch> requested) {
    facts.maxTexelBufferElements = texelCount;
    facts.maxStorageBufferRange = storageByteCount;
    return traceChoiceFor(facts, {.fetch = requested}, traced.scene().bvh).fetch;
  };
  facts.kind = DeviceKind::Discrete;
  CHECK(fetchWith(blockCount, 16 * blockCount, {}) == BvhFetch::Storage);
  CHECK(fetchWith(blockCount, 16 * blockCount - 1, {}) == BvhFetch::Texel);
  CHECK(fetchWith(blockCount - 1, 16 * blockCount - 1, {}) == BvhFetch::Storage);
  CHECK(fetchWith(blockCount, 100, BvhFetch::Storage) == BvhFetch::Storage);
  facts.kind = DeviceKind::Cpu;
  CHECK(fetchWith(blockCount, 16 * blockCount, {}) == BvhFetch::Texel);
  CHECK(fetchWith(blockCount - 1, 16 * blockCount, {}) == BvhFetch::Storage);
  CHECK(fetchWith(100, 16 * blockCount, BvhFetch::Texel) == BvhFetch::Texel);
}

TEST_CASE("a device without the subgroup operations of a kernel is refused with a remedy") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.hasSubgroupArithmetic = false;
  const Device noArithmetic(physical, facts);
  const VulkanTraceChoice packet{TraceKernel::Packet, BvhFetch::Texel};
  CHECK_THROWS_WITH_AS(VulkanConeKernel(noArithmetic, {30, false, packet}), doctest::Contains("subgroup arithmetic"),
                       Error);
  CHECK_NOTHROW(VulkanConeKernel(noArithmetic, {30}));
  facts.hasSubgroupVote = false;
  const Device noVote(physical, facts);
  CHECK_THROWS_WITH_AS(VulkanConeKernel(noVote, {30}), doctest::Contains("no subgroup vote"), Error);
}

TEST_CASE("a mesh beyond a device's limits is refused with a remedy") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxTexelBufferElements = 100;
  const Device small(physical, facts);
  const VulkanConeKernel kernel(small, {30, false, VulkanTraceChoice{}});
  const TracedMesh traced(generateShape("sphere", 500).mesh);
  const Cone cone = makeCone({});
  CHECK_THROWS_WITH_AS((void)makeVulkanTracer(kernel, traced.scene(), cone), doctest::Contains("texels in one buffer"),
                       Error);
}

TEST_CASE("a mesh beyond the range of a storage buffer is refused") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  const TracedMesh traced(generateShape("sphere", 2000).mesh);
  const Cone cone = makeCone({});
  DeviceFacts facts = describeDevice(physical);
  const auto make = [&](uint64_t range) {
    facts.maxStorageBufferRange = range;
    const Device device(physical, facts);
    const VulkanConeKernel kernel(device, {30, false, VulkanTraceChoice{TraceKernel::Seed, BvhFetch::Storage}});
    (void)makeVulkanTracer(kernel, traced.scene(), cone);
  };
  CHECK_NOTHROW(make(48 * traced.mesh.faces.size()));
  test::requireFailure([&] { make(48 * traced.mesh.faces.size() - 1); }, ErrorCode::DeviceLimit, "one storage buffer");
}

TEST_CASE("a device with too few storage buffers for a kernel is refused before the kernel is made") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxStorageBuffersPerStage = 2;
  const Device small(physical, facts);
  CHECK_THROWS_WITH_AS(VulkanConeKernel(small, {30}), doctest::Contains("storage buffers"), Error);
}
