#include "trace/vulkan/vulkan_tracer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "generate/shapes.h"
#include "spirv/trace_packet.comp.h"
#include "spirv/trace_rays.comp.h"
#include "spirv/trace_reduce.comp.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/specialization_ids.h"
#include "support/test_device.h"
#include "trace/chunks.h"
#include "trace_results.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

TraceResults traceWith(const VulkanConeKernel& kernel, const TracedMesh& traced, const ConeOptions& options = {},
                       const RunControl& control = {}) {
  return traceByKernel(kernel, traced, options, Wanted::Values, control);
}

std::vector<double> referenceValues(const TracedMesh& traced, const ConeOptions& options = {}) {
  return traceByReference(traced, options, Wanted::Values).values;
}

void checkParity(const VulkanConeKernel& kernel, const TracedMesh& traced, const ConeOptions& options,
                 const std::vector<double>& reference) {
  const std::vector<double> values = traceWith(kernel, traced, options).values;
  CHECK(differingCount(values, reference, traced.geometry.bounds.diagonal()) <= reference.size() / 1000);
}

std::vector<std::vector<double>> referencesOf(const std::vector<TracedMesh>& meshes) {
  std::vector<std::vector<double>> references;
  for (const TracedMesh& traced : meshes) references.push_back(referenceValues(traced));
  return references;
}

}  // namespace

TEST_CASE("the kernel gives the reference's values on every generated shape" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  std::vector<TracedMesh> meshes;
  for (const std::string_view name : shapeNames()) meshes.emplace_back(generateShape(name, 1200).mesh);
  const std::vector<std::vector<double>> references = referencesOf(meshes);
  forEveryVariant(Fetches::All, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {30, false, choice});
    for (size_t i = 0; i < meshes.size(); ++i) {
      CAPTURE(shapeNames()[i]);
      checkParity(kernel, meshes[i], {}, references[i]);
    }
  });
}

TEST_CASE("the kernel gives the reference's values on open, crossing, nested and non-manifold meshes") {
  const test::ValidatedDevice device;
  std::vector<TracedMesh> meshes;
  for (const Mesh& mesh :
       {shapes::openBox({1, 2, 3}, 8), shapes::soup(2000, 5), shapes::shell(2, 1),
        shapes::jittered(shapes::boxesWithSharedEdge(), 1e-3, 1), shapes::inverted(shapes::icosphere(3))})
    meshes.emplace_back(mesh);
  const std::vector<std::vector<double>> references = referencesOf(meshes);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {30, false, choice});
    for (size_t i = 0; i < meshes.size(); ++i) {
      CAPTURE(i);
      checkParity(kernel, meshes[i], {}, references[i]);
    }
  });
}

TEST_CASE("any number of rays from 1 to 1024 gives the reference's values" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("torus", 200).mesh);
  for (const uint32_t rayCount : {1u, 2u, 3u, 7u, 8u, 9u, 31u, 32u, 33u, 64u, 100u, 255u, 256u, 257u, 1000u, 1024u}) {
    CAPTURE(rayCount);
    const std::vector<double> reference = referenceValues(traced, {.rayCount = rayCount});
    for (const TraceKernel kernel : {TraceKernel::Packet, TraceKernel::Ray, TraceKernel::Seed})
      checkParity(VulkanConeKernel(*device, {rayCount, false, VulkanTraceChoice{kernel}}), traced,
                  {.rayCount = rayCount}, reference);
  }
}

TEST_CASE("any workgroup shape gives the same bits" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const ConeKernelRequest request{30, false, choice};
    const std::vector<double> expected = traceWith(VulkanConeKernel(*device, request), traced).values;
    for (const VulkanWorkgroupShape shape : {VulkanWorkgroupShape{8, 1, 8000}, VulkanWorkgroupShape{16, 3, 8000},
                                             VulkanWorkgroupShape{32, 4, 8000}, VulkanWorkgroupShape{64, 2, 8000}}) {
      CAPTURE(shape.lanesPerCone);
      CHECK(test::haveSameBits(traceWith(VulkanConeKernel(*device, request, shape), traced).values, expected));
    }
  });
}

TEST_CASE("long stacks and triangles that are not postponed give the same bits" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const VulkanWalkShape gpu{.stackSize = 65, .postponesTriangles = false};
  for (const TraceKernel kernel : {TraceKernel::Ray, TraceKernel::Seed}) {
    CAPTURE(static_cast<int>(kernel));
    const ConeKernelRequest request{30, false, VulkanTraceChoice{kernel}};
    const VulkanWorkgroupShape shape = workgroupShapeFor(device->facts(), 30, kernel);
    const TraceResults expected = traceWith(VulkanConeKernel(*device, request, shape, VulkanWalkShape{}), traced);
    const TraceResults results = traceWith(VulkanConeKernel(*device, request, shape, gpu), traced);
    CHECK(results.statistics.redoneConeCount == 0);
    CHECK(test::haveSameBits(results.values, expected.values));
  }
}

TEST_CASE("AMD GPUs have stacks of more than 256 bytes, and only CPU devices postpone triangles") {
  const auto shapeOf = [](DeviceKind kind, DeviceVendor vendor) {
    DeviceFacts facts;
    facts.kind = kind;
    facts.vendor = vendor;
    return walkShapeFor(facts);
  };
  const VulkanWalkShape amd = shapeOf(DeviceKind::Integrated, DeviceVendor::Amd);
  CHECK(amd.stackSize > 64);
  CHECK_FALSE(amd.postponesTriangles);
  for (const VulkanWalkShape& shape :
       {shapeOf(DeviceKind::Cpu, DeviceVendor::Other), shapeOf(DeviceKind::Discrete, DeviceVendor::Nvidia)}) {
    CHECK(shape.stackSize == kMaxBvhDepth);
  }
  CHECK(shapeOf(DeviceKind::Cpu, DeviceVendor::Other).postponesTriangles);
  CHECK_FALSE(shapeOf(DeviceKind::Discrete, DeviceVendor::Nvidia).postponesTriangles);
}

TEST_CASE("cones beyond the iteration guard are redone by the reference and counted" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const std::vector<double> reference = referenceValues(traced);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const ConeKernelRequest request{30, false, choice};
    const TraceResults all = traceWith(VulkanConeKernel(*device, request, VulkanWorkgroupShape{32, 1, 1}), traced);
    CHECK(all.statistics.redoneConeCount == reference.size());
    CHECK(test::haveSameBits(all.values, reference));
    const TraceResults some = traceWith(VulkanConeKernel(*device, request, VulkanWorkgroupShape{32, 1, 45}), traced);
    CHECK(some.statistics.redoneConeCount > 0);
    CHECK(some.statistics.redoneConeCount < reference.size());
    CHECK(differingCount(some.values, reference, traced.geometry.bounds.diagonal()) <= reference.size() / 1000);
  });
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

TEST_CASE("hostile cones run into the device's own guard, are redone and agree" * doctest::test_suite("slow")) {
  // Long needles through one another: each ray enters most of their boxes.
  Mesh needles;
  Random random(4);
  const auto point = [&] { return Vec3d{random.real() * 2 - 1, random.real() * 2 - 1, random.real() * 2 - 1}; };
  for (uint32_t i = 0; i < 80'000; ++i) {
    const Vec3d a = point();
    needles.vertices.insert(needles.vertices.end(), {a, -a, a + point() * 1e-3});
    needles.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const test::ValidatedDevice device;
  const TracedMesh traced(needles);
  const Cone cone = makeCone({});
  const std::vector<uint32_t> all = traced.seedFaces();
  const std::vector<uint32_t> seeds(all.begin(), all.begin() + 3);
  std::vector<double> values(seeds.size()), reference(seeds.size());
  makeReferenceTracer(traced.scene(), cone)->trace(seeds, {reference}, {});
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    VulkanTraceChoice fitting = choice;
    if (device->facts().maxTexelBufferElements < 3 * needles.faces.size()) fitting.fetch = BvhFetch::Storage;
    const VulkanConeKernel kernel(*device, {30, false, fitting});
    const TraceStatistics statistics = makeVulkanTracer(kernel, traced.scene(), cone)->trace(seeds, {values}, {});
    if (device->facts().endsLongLoops) CHECK(statistics.redoneConeCount > 0);
    CHECK(differingCount(values, reference, traced.geometry.bounds.diagonal()) <= 1);
  });
}

TEST_CASE("details too small for float32 are traced by the reference") {
  const Mesh large = generateShape("sphere", 500).mesh;
  const Mesh tiny = shapes::scaledAndShifted(large, 1e-6, {0.9, 0.9, 0.9});
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {30});
  const TracedMesh traced(shapes::joined(large, tiny));
  const std::vector<double> reference = referenceValues(traced);
  const TraceResults result = traceWith(kernel, traced);
  CHECK(result.statistics.redoneConeCount == tiny.faces.size());
  for (size_t i = large.faces.size(); i < reference.size(); ++i) CHECK(result.values[i] == reference[i]);

  const TracedMesh thin(generateShape("slab", 500).mesh);  // its faces are large, its thickness is not
  Mesh flat = thin.mesh;
  for (Vec3d& v : flat.vertices) v.z *= 1e-5;
  const TracedMesh flattened(flat);
  const std::vector<double> flatReference = referenceValues(flattened);
  const std::vector<double> flatValues = traceWith(kernel, flattened).values;
  for (size_t i = 0; i < flatReference.size(); ++i)
    CHECK(flatValues[i] == doctest::Approx(flatReference[i]).epsilon(1e-3));
}

TEST_CASE("rays along the sides of boxes do not leak") {
  // Flat, axis-aligned boxes: a cone's ray may run exactly in the plane of a hierarchy's box.
  const test::ValidatedDevice device;
  std::vector<TracedMesh> boxes;
  for (const uint32_t side : {1u, 3u, 10u}) boxes.emplace_back(shapes::box({2, 3, 0.01}, side));
  const std::vector<std::vector<double>> references = referencesOf(boxes);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {30, false, choice});
    for (size_t i = 0; i < boxes.size(); ++i) {
      CAPTURE(i);
      const TraceResults result = traceWith(kernel, boxes[i]);
      CHECK(differingCount(result.values, references[i], boxes[i].geometry.bounds.diagonal()) == 0);
    }
  });
}

TEST_CASE("the angle of false hits and the bound on outliers are options that every backend obeys") {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const std::vector<double> defaults = referenceValues(traced);
  const std::array<ConeOptions, 4> variants{{{.falseHitAngleDegrees = 20},
                                             {.falseHitAngleDegrees = 150},
                                             {.outlierDeviations = 3},
                                             {.outlierDeviations = 0.5}}};
  std::vector<std::vector<double>> references;
  for (const ConeOptions& options : variants) {
    references.push_back(referenceValues(traced, options));
    CHECK(differingCount(references.back(), defaults, traced.geometry.bounds.diagonal()) > 100);
  }
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {30, false, choice});
    for (size_t i = 0; i < variants.size(); ++i) {
      CAPTURE(i);
      checkParity(kernel, traced, variants[i], references[i]);
    }
  });
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

TEST_CASE("the vendor decides where the reported subgroup size is not that of the kernels") {
  DeviceFacts facts;
  facts.kind = DeviceKind::Integrated;
  facts.subgroupSize = 32;
  facts.vendor = DeviceVendor::Intel;
  CHECK(defaultTraceChoice(facts).kernel == TraceKernel::Seed);
  facts.subgroupSize = 8;
  for (const DeviceVendor vendor : {DeviceVendor::Nvidia, DeviceVendor::Amd}) {
    facts.vendor = vendor;
    CHECK(defaultTraceChoice(facts).kernel == TraceKernel::Ray);
  }
  facts.vendor = DeviceVendor::Other;
  CHECK(defaultTraceChoice(facts).kernel == TraceKernel::Seed);
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
  const DeviceBvh encoded = encodeDeviceBvh(traced.scene().bvh, traced.mesh, traced.geometry);
  CHECK(encoded.nodes.size() * sizeof(DeviceWideNode) <= 16 * blockCount);
  CHECK(encoded.triangles.size() * sizeof(DeviceTriangle) <= 16 * blockCount);
  CHECK(blockCount <= 6 * encoded.triangles.size());

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

TEST_CASE("two runs on the device give the same bits, whatever the order of the seeds") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {30});
  const TracedMesh traced(generateShape("hand", 4000).mesh);
  const Cone cone = makeCone({});
  std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> forward(seeds.size()), backward(seeds.size());
  const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
  tracer->trace(seeds, {forward}, {});
  std::reverse(seeds.begin(), seeds.end());
  tracer->trace(seeds, {backward}, {});
  std::reverse(backward.begin(), backward.end());
  CHECK(test::haveSameBits(forward, backward));
}

TEST_CASE("copies of faces, and degenerate ones beside them, change no value") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {30});
  Mesh mesh = generateShape("torus", 600).mesh;
  const std::vector<double> expected = traceWith(kernel, TracedMesh(mesh)).values;
  const size_t count = mesh.faces.size();
  for (size_t f = 0; f < count; f += 7) mesh.faces.push_back(mesh.faces[f]);
  mesh.faces.push_back({0, 0, 1});
  const std::vector<double> values = traceWith(kernel, TracedMesh(mesh)).values;
  for (size_t f = 0; f < count; ++f) CHECK(values[f] == doctest::Approx(expected[f]).epsilon(1e-6));
  for (size_t i = 0; count + i < values.size(); ++i)
    CHECK(values[count + i] == doctest::Approx(expected[7 * i]).epsilon(1e-6));
}

TEST_CASE("a trace on the device stops between chunks on request") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {30});
  const TracedMesh traced(generateShape("torus", 40'000).mesh);
  std::stop_source stop;
  uint32_t checkpointCount = 0;
  const RunControl control{stop.get_token(), [&](double fraction) {
                             ++checkpointCount;
                             if (fraction > 0) stop.request_stop();
                           }};
  try {
    (void)traceWith(kernel, traced, {}, control);
    FAIL("it ran to the end");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
  CHECK(checkpointCount == 2);
}

TEST_CASE("chunks grow and shrink towards their time, within bounds") {
  ChunkSize chunk(1000, 1'000'000);
  chunk.adapt(1000, ChunkSize::kTargetSeconds / 1000);
  CHECK(chunk.current() == 4000);
  chunk.adapt(4000, ChunkSize::kTargetSeconds * 2);
  CHECK(chunk.current() == doctest::Approx(2000).epsilon(0.01));
  for (int i = 0; i < 20; ++i) chunk.adapt(chunk.current(), 1e-9);
  CHECK(chunk.current() == 1'000'000);
  for (int i = 0; i < 20; ++i) chunk.adapt(chunk.current(), 100);
  CHECK(chunk.current() == ChunkSize::kMin);
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

TEST_CASE("a hierarchy beyond the texel limit of a device is traced with storage and refused with texels") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxTexelBufferElements = 100;
  facts.maxStorageBuffersPerStage = 4;  // The least that Vulkan allows.
  const Device small(physical, facts);
  const TracedMesh traced(generateShape("torus", 1200).mesh);
  const Cone cone = makeCone({});
  const auto kernelFor = [&](BvhFetch fetch) {
    return VulkanConeKernel(small, {30, false, VulkanTraceChoice{TraceKernel::Ray, fetch}});
  };
  checkParity(kernelFor(BvhFetch::Storage), traced, {}, referenceValues(traced));
  const VulkanConeKernel texels = kernelFor(BvhFetch::Texel);
  test::requireFailure([&] { (void)makeVulkanTracer(texels, traced.scene(), cone); }, ErrorCode::DeviceLimit,
                       "texels in one buffer");
}

TEST_CASE("a device with too few storage buffers for a kernel is refused before the kernel is made") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxStorageBuffersPerStage = 2;
  const Device small(physical, facts);
  CHECK_THROWS_WITH_AS(VulkanConeKernel(small, {30}), doctest::Contains("storage buffers"), Error);
}
