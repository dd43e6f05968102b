#include "trace/vk/vulkan_tracer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "generate/shapes.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/test_device.h"
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
    for (const auto& [name, kernel] : kKernels)
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
