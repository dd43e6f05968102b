#include <doctest/doctest.h>

#include <cmath>

#include "core/check.h"
#include "generate/shapes.h"
#include "hit_checks.h"
#include "hit_comparison.h"
#include "shapes.h"
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

void checkHits(const VulkanConeKernel& kernel, const TracedMesh& traced, const ConeOptions& options = {}) {
  const TraceResults results = hitsByKernel(kernel, traced, options);
  CHECK(differingRays(results.hits, hitsByReference(traced, options).hits) <= results.hits.size() / 1000);
  const double diagonal = traced.geometry.bounds.diagonal();
  CHECK(differingCount(valuesOfHits(traced, options, results.hits), results.values, diagonal) <=
        results.values.size() / 1000);
}

}  // namespace

TEST_CASE("the kernel's hits are the reference's, and give its values") {
  const test::ValidatedDevice device;
  forEveryVariant(Fetches::All, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {kRayCount, true, choice});
    checkHits(kernel, TracedMesh(generateShape("animal", 2000).mesh));
    checkHits(kernel, TracedMesh(generateShape("hand", 2000).mesh), {.rotation = ConeRotation::Hashed});
    checkHits(kernel, TracedMesh(shapes::jittered(shapes::icosphere(3), 0.02, 1)), {.falseHitAngleDegrees = 30});
    checkHits(kernel, TracedMesh(shapes::soup(2000, 5)));
    checkHits(kernel, TracedMesh(shapes::jittered(shapes::openBox({1, 2, 3}, 8), 0.01, 2)));
  });
}

TEST_CASE("rays that meet nothing say so on both backends") {
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

TEST_CASE("any number of rays gives the reference's hits") {
  const test::ValidatedDevice device;
  const TracedMesh traced(shapes::jittered(shapes::icosphere(2), 0.02, 3));
  for (const uint32_t rayCount : {1u, 7u, 33u, 257u, 1024u}) {
    CAPTURE(rayCount);
    for (const TraceKernel kernel : {TraceKernel::Packet, TraceKernel::Ray, TraceKernel::Seed})
      checkHits(VulkanConeKernel(*device, {rayCount, true, VulkanTraceChoice{kernel, BvhLayout::Wide}}), traced,
                {.rayCount = rayCount});
  }
}

TEST_CASE("writing hits changes no bit of the values") {
  const test::ValidatedDevice device;
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel writing(*device, {kRayCount, true, choice}), plain(*device, {kRayCount, false, choice});
    for (const std::string_view name : {"animal", "hand", "torus"}) {
      const TracedMesh traced(generateShape(name, 2000).mesh);
      const std::vector<double> expected = traceByKernel(plain, traced, {}, Wanted::Values).values;
      CHECK(haveSameBits(hitsByKernel(writing, traced).values, expected));
      CHECK(haveSameBits(traceByKernel(writing, traced, {}, Wanted::Values).values, expected));
    }
  });
}

TEST_CASE("any workgroup shape gives the same hits") {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const ConeKernelRequest request{kRayCount, true, choice};
    const std::vector<ConeHit> expected = hitsByKernel(VulkanConeKernel(*device, request), traced).hits;
    for (const VulkanWorkgroupShape shape :
         {VulkanWorkgroupShape{8, 1, 8000}, VulkanWorkgroupShape{16, 3, 8000}, VulkanWorkgroupShape{64, 2, 8000}})
      CHECK(haveSameBits(hitsByKernel(VulkanConeKernel(*device, request, shape), traced).hits, expected));
  });
}

TEST_CASE("hits of cones that the reference redoes are the reference's") {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const TraceResults reference = hitsByReference(traced);
  const TraceResults all = hitsByKernel(VulkanConeKernel(*device, {kRayCount, true}, {32, 1, 1}), traced);
  CHECK(all.statistics.redoneConeCount == reference.values.size());
  CHECK(haveSameBits(all.hits, reference.hits));
  const TraceResults some = hitsByKernel(VulkanConeKernel(*device, {kRayCount, true}, {32, 1, 45}), traced);
  CHECK(some.statistics.redoneConeCount > 0);
  CHECK(some.statistics.redoneConeCount < reference.values.size());
  CHECK(differingRays(some.hits, reference.hits) <= reference.hits.size() / 1000);
}

TEST_CASE("hits do not depend on where a chunk ends") {
  const Instance instance({.validation = true});
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  const DeviceFacts facts = describeDevice(physical);
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const Device whole(physical, facts);
  const TraceResults expected = hitsByKernel(VulkanConeKernel(whole, {kRayCount, true}), traced);

  DeviceFacts limited = facts;
  limited.maxStorageBufferRange = 101 * kRayCount * sizeof(ConeHit) + 1;
  const Device small(physical, limited);
  uint32_t checkpointCount = 0;
  const RunControl counting{{}, [&](double) { ++checkpointCount; }};
  const TraceResults results = hitsByKernel(VulkanConeKernel(small, {kRayCount, true}), traced, {}, counting);
  CHECK(checkpointCount >= results.values.size() / 101);
  CHECK(haveSameBits(results.hits, expected.hits));
  CHECK(haveSameBits(results.values, expected.values));

  const TraceResults redone = hitsByKernel(VulkanConeKernel(small, {kRayCount, true}, {32, 1, 1}), traced);
  CHECK(haveSameBits(redone.hits, hitsByReference(traced).hits));
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

TEST_CASE("hits asked of a kernel that writes none are refused") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {kRayCount});
  const TracedMesh traced(shapes::icosphere(0));
  CHECK_THROWS_AS((void)hitsByKernel(kernel, traced), CheckFailure);
}
