#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "generate/shapes.h"
#include "hit_checks.h"
#include "hit_comparison.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

constexpr uint32_t kRayCount = 30;

TraceResults hitsByKernel(const VulkanConeKernel& kernel, const TracedMesh& traced, const ConeOptions& options = {},
                          const RunControl& control = {}) {
  return traceByKernel(kernel, traced, options, Wanted::ValuesAndHits, control);
}

TraceResults hitsByReference(const TracedMesh& traced, const ConeOptions& options = {}) {
  return traceByReference(traced, options, Wanted::ValuesAndHits);
}

/// The reference results for all kernels; traced once.
struct ReferenceHits {
  TracedMesh traced;
  ConeOptions options;
  std::vector<ConeHit> hits;

  explicit ReferenceHits(const Mesh& mesh, const ConeOptions& coneOptions = {})
      : traced(mesh), options(coneOptions), hits(hitsByReference(traced, options).hits) {}
};

void checkHits(const VulkanConeKernel& kernel, const ReferenceHits& reference) {
  const auto& [traced, options, hits] = reference;
  const TraceResults results = hitsByKernel(kernel, traced, options);
  CHECK(differingRays(results.hits, hits) <= results.hits.size() / 1000);
  const double diagonal = traced.geometry.bounds.diagonal();
  CHECK(differingCount(valuesOfHits(traced, options, results.hits), results.values, diagonal) <=
        results.values.size() / 1000);
}

}  // namespace

TEST_CASE("the kernel's hits are the reference's, and give its values" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  std::vector<ReferenceHits> references;
  references.emplace_back(generateShape("animal", 800).mesh);
  references.emplace_back(generateShape("hand", 800).mesh, ConeOptions{.rotation = ConeRotation::Hashed});
  references.emplace_back(shapes::jittered(shapes::icosphere(2), 0.02, 1), ConeOptions{.falseHitAngleDegrees = 30});
  references.emplace_back(shapes::soup(800, 5));
  references.emplace_back(shapes::jittered(shapes::openBox({1, 2, 3}, 6), 0.01, 2));
  forEveryVariant(Fetches::All, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {kRayCount, true, choice});
    for (const ReferenceHits& reference : references) checkHits(kernel, reference);
  });
}

TEST_CASE("rays without a hit are misses on both backends") {
  const test::ValidatedDevice device;
  const TracedMesh open(shapes::jittered(shapes::openBox({1, 1, 1}, 6), 0.02, 2));
  const size_t expected = missCount(hitsByReference(open).hits);
  CHECK(expected > 100);
  const TracedMesh alone(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}});
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {kRayCount, true, choice});
    CHECK(missCount(hitsByKernel(kernel, open).hits) == expected);
    const TraceResults none = hitsByKernel(kernel, alone);
    CHECK(missCount(none.hits) == kRayCount);
    CHECK(std::isnan(none.values.front()));
  });
}

TEST_CASE("any number of rays gives the reference's hits" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const Mesh mesh = shapes::jittered(shapes::icosphere(1), 0.02, 3);
  for (const uint32_t rayCount : {1u, 7u, 33u, 257u, 1024u}) {
    CAPTURE(rayCount);
    const ReferenceHits reference(mesh, {.rayCount = rayCount});
    for (const auto& [name, kernel] : kKernels)
      checkHits(VulkanConeKernel(*device, {rayCount, true, VulkanTraceChoice{kernel}}), reference);
  }
}

TEST_CASE("writing hits changes no bit of the values" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  std::vector<TracedMesh> meshes;
  for (const std::string_view name : {"animal", "hand", "torus"}) meshes.emplace_back(generateShape(name, 2000).mesh);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel writing(*device, {kRayCount, true, choice}), plain(*device, {kRayCount, false, choice});
    for (const TracedMesh& traced : meshes) {
      const std::vector<double> expected = traceByKernel(plain, traced, {}, Wanted::Values).values;
      CHECK(test::haveSameBits(hitsByKernel(writing, traced).values, expected));
      CHECK(test::haveSameBits(traceByKernel(writing, traced, {}, Wanted::Values).values, expected));
    }
  });
}

TEST_CASE("any workgroup shape gives the same hits" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const ConeKernelRequest request{kRayCount, true, choice};
    const std::vector<ConeHit> expected = hitsByKernel(VulkanConeKernel(*device, request), traced).hits;
    for (const VulkanWorkgroupShape shape :
         {VulkanWorkgroupShape{8, 1, 8000}, VulkanWorkgroupShape{16, 3, 8000}, VulkanWorkgroupShape{64, 2, 8000}})
      CHECK(test::haveSameBits(hitsByKernel(VulkanConeKernel(*device, request, shape), traced).hits, expected));
  });
}

TEST_CASE("hits of cones that the reference redoes are the reference's") {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const TraceResults reference = hitsByReference(traced);
  const TraceResults all =
      hitsByKernel(VulkanConeKernel(*device, {kRayCount, true}, VulkanWorkgroupShape{32, 1, 1}), traced);
  CHECK(all.statistics.redoneConeCount == reference.values.size());
  CHECK(test::haveSameBits(all.hits, reference.hits));
  const TraceResults some =
      hitsByKernel(VulkanConeKernel(*device, {kRayCount, true}, VulkanWorkgroupShape{32, 1, 45}), traced);
  CHECK(some.statistics.redoneConeCount > 0);
  CHECK(some.statistics.redoneConeCount < reference.values.size());
  CHECK(differingRays(some.hits, reference.hits) <= reference.hits.size() / 1000);
}

TEST_CASE("hits on the device are those on the host: of several calls, in growing memory, and of redone cones") {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const std::vector<uint32_t> seeds = traced.seedFaces();
  const Cone cone = makeCone({});
  for (const bool redoes : {false, true}) {
    VulkanWorkgroupShape shape{32, 1};
    if (redoes) shape.iterationLimit = 45;
    const VulkanConeKernel kernel(*device, {kRayCount, true}, shape);
    const TraceResults expected = hitsByKernel(kernel, traced);
    const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
    const std::unique_ptr<DeviceHits> kept = tracer->makeDeviceHits();
    std::vector<double> values(seeds.size());
    uint64_t redoneCount = 0;
    size_t done = 0;
    for (const size_t count : {size_t{300}, size_t{0}, size_t{1}, seeds.size() - 301}) {
      kept->reserve(done + count);
      redoneCount += tracer
                         ->trace(std::span(seeds).subspan(done, count),
                                 {.values = std::span(values).subspan(done, count), .onDevice = kept.get()}, {})
                         .redoneConeCount;
      done += count;
    }
    CHECK((redoneCount > 0) == redoes);
    CHECK(redoneCount < seeds.size());
    std::vector<ConeHit> hits(seeds.size() * kRayCount);
    kept->download(hits);
    CHECK(test::haveSameBits(values, expected.values));
    CHECK(test::haveSameBits(hits, expected.hits));
  }
}

TEST_CASE("where the hits exceed a limit of the device, the earlier ones remain") {
  const auto limited =
      test::ValidatedDevice::changed([](DeviceFacts& facts) { facts.maxStorageBufferRange = 1 << 20; });
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const std::vector<uint32_t> seeds{5, 3, 700};
  VulkanTraceChoice choice = defaultTraceChoice(limited->facts());
  const Cone cone = makeCone({});
  const VulkanConeKernel kernel(*limited, {kRayCount, true, choice});
  const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
  const std::unique_ptr<DeviceHits> kept = tracer->makeDeviceHits();
  std::vector<double> values(seeds.size());
  std::vector<ConeHit> hits(seeds.size() * kRayCount), expected(hits.size());
  kept->reserve(seeds.size());
  (void)tracer->trace(seeds, {.values = values, .onDevice = kept.get()}, {});
  (void)tracer->trace(seeds, {values, expected}, {});
  test::requireFailure([&] { kept->reserve((1 << 20) / (kRayCount * sizeof(ConeHit)) + 1); }, ErrorCode::DeviceLimit,
                       "in one storage buffer");
  kept->download(hits);
  CHECK(test::haveSameBits(hits, expected));
}

TEST_CASE("hits do not depend on where a chunk ends") {
  const Instance instance({.validation = true});
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  const DeviceFacts facts = describeDevice(physical);
  VulkanTraceChoice choice = defaultTraceChoice(facts);
  choice.fetch = BvhFetch::Texel;  // The hierarchy exceeds the range below.
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const Device whole(physical, facts);
  const TraceResults expected = hitsByKernel(VulkanConeKernel(whole, {kRayCount, true, choice}), traced);

  DeviceFacts limited = facts;
  limited.maxStorageBufferRange = 101 * kRayCount * sizeof(ConeHit) + 1;
  const Device small(physical, limited);
  uint32_t checkpointCount = 0;
  const RunControl counting{{}, [&](double) { ++checkpointCount; }};
  const TraceResults results = hitsByKernel(VulkanConeKernel(small, {kRayCount, true, choice}), traced, {}, counting);
  CHECK(checkpointCount >= results.values.size() / 101);
  CHECK(test::haveSameBits(results.hits, expected.hits));
  CHECK(test::haveSameBits(results.values, expected.values));

  const TraceResults redone =
      hitsByKernel(VulkanConeKernel(small, {kRayCount, true, choice}, VulkanWorkgroupShape{32, 1, 1}), traced);
  CHECK(test::haveSameBits(redone.hits, hitsByReference(traced).hits));
  CHECK(instance.validationLog()->messages().empty());
}

TEST_CASE("turned cones have the reference's values, which are not those of fixed ones") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {kRayCount});
  const ConeOptions hashed{.rotation = ConeRotation::Hashed};
  const TracedMesh traced(generateShape("animal", 3000).mesh);
  const std::vector<double> values = traceByKernel(kernel, traced, hashed, Wanted::Values).values;
  const double diagonal = traced.geometry.bounds.diagonal();
  CHECK(differingCount(values, traceByReference(traced, hashed, Wanted::Values).values, diagonal) <=
        values.size() / 1000);
  CHECK(differingCount(values, traceByKernel(kernel, traced, {}, Wanted::Values).values, diagonal) > values.size() / 2);
}

TEST_CASE("requesting hits from a kernel that writes none is refused") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {kRayCount});
  const TracedMesh traced(shapes::icosphere(0));
  CHECK_THROWS_AS((void)hitsByKernel(kernel, traced), CheckFailure);
}
