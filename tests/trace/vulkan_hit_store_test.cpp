#include "trace/vulkan/vulkan_hit_store.h"

#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "core/check.h"
#include "generate/shapes.h"
#include "shared/cone_hit.h"
#include "support/bits.h"
#include "support/test_device.h"
#include "trace_results.h"

using namespace asdfvk;

namespace {

constexpr uint32_t kStoredRayCount = 30;

/// The hits of all seed faces of a mesh, traced in two batches.
struct StoredHits {
  std::vector<double> values;
  std::vector<ConeHit> onHost, stored;
};

/// atPoints: with traceAt() instead of trace().
StoredHits traceIntoStore(const VulkanConeKernel& kernel, const TracedMesh& traced, bool atPoints) {
  const Cone cone = makeCone({.rayCount = kStoredRayCount});
  const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
  const VulkanHitStoreKernel storeKernel(kernel.device());
  VulkanHitStore store(storeKernel, kStoredRayCount);
  const std::vector<uint32_t> seeds = traced.seedFaces();
  StoredHits hits{std::vector<double>(seeds.size()), std::vector<ConeHit>(seeds.size() * kStoredRayCount), {}};
  const size_t firstCount = seeds.size() / 3;
  for (const auto& [begin, count] :
       {std::pair{size_t{0}, firstCount}, std::pair{firstCount, seeds.size() - firstCount}}) {
    store.reserve(count);
    const std::span<const uint32_t> faces = std::span(seeds).subspan(begin, count);
    ConeResults results{std::span(hits.values).subspan(begin, count), {}, &store};
    if (begin > 0) results.hits = std::span(hits.onHost).subspan(begin * kStoredRayCount);  // Both.
    if (atPoints) {
      std::vector<ConeStart> starts;
      for (const uint32_t face : faces) starts.push_back(coneStartOfFace(traced.scene(), cone, face));
      tracer->traceAt(starts, results, {});
    } else {
      tracer->trace(faces, results, {});
    }
  }
  CHECK(store.seedCount() == seeds.size());
  hits.stored = store.download();
  return hits;
}

}  // namespace

TEST_CASE("hits that a trace stores on the device are those that the host receives") {
  const Instance instance({.validation = true});
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  const DeviceFacts facts = describeDevice(physical);
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const VulkanTraceChoice choice{.kernel = TraceKernel::Seed, .fetch = BvhFetch::Texel};
  const Device whole(physical, facts);
  DeviceFacts separate = facts, small = facts;
  separate.mapsDeviceMemory = small.mapsDeviceMemory = false;
  const Device separateDevice(physical, separate);
  for (const bool atPoints : {false, true})
    for (const Device* device : {&whole, &separateDevice})
      for (const VulkanWorkgroupShape& shape :  // The second and third leave some or all cones to the reference.
           {VulkanWorkgroupShape{32, 1, 8000}, VulkanWorkgroupShape{32, 1, 45}, VulkanWorkgroupShape{32, 1, 1}}) {
        CAPTURE(shape.iterationLimit);
        CAPTURE(atPoints);
        const VulkanConeKernel kernel(*device, {kStoredRayCount, true, choice}, shape);
        const TraceResults expected =
            traceByKernel(kernel, traced, {.rayCount = kStoredRayCount}, Wanted::ValuesAndHits);
        const StoredHits hits = traceIntoStore(kernel, traced, atPoints);
        if (atPoints) {  // Its starts come from the host instead of from a kernel.
          CHECK(differingCount(hits.values, expected.values, traced.geometry.bounds.diagonal()) <= 2);
        } else {
          CHECK(test::haveSameBits(hits.values, expected.values));
          CHECK(test::haveSameBits(hits.stored, expected.hits));
        }
        const size_t begin = hits.values.size() / 3 * kStoredRayCount;
        CHECK(test::haveSameBits(
            std::vector(hits.stored.begin() + static_cast<std::ptrdiff_t>(begin), hits.stored.end()),
            std::vector(hits.onHost.begin() + static_cast<std::ptrdiff_t>(begin), hits.onHost.end())));
      }
  CHECK(instance.validationLog()->messages().empty());
}

TEST_CASE("cones in an empty scene store misses") {
  const test::ValidatedDevice device;
  const TracedMesh traced(Mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}, {}});
  REQUIRE(traced.bvh.nodes.empty());
  const Cone cone = makeCone({.rayCount = kStoredRayCount});
  const VulkanConeKernel kernel(*device, {kStoredRayCount, true});
  const VulkanHitStoreKernel storeKernel(*device);
  VulkanHitStore store(storeKernel, kStoredRayCount);
  store.reserve(2);
  const std::vector<ConeStart> starts(2, coneStartAt(cone, {0, 0, 0}, {0, 0, 1}));
  std::vector<double> values(2);
  makeVulkanTracer(kernel, traced.scene(), cone)->traceAt(starts, {values, {}, &store}, {});
  REQUIRE(store.seedCount() == 2);
  for (const ConeHit& hit : store.download()) CHECK(hit.face == kNoFace);
}

TEST_CASE("a store is refused by a tracer elsewhere, with other cones or without its memory") {
  const test::ValidatedDevice device, other;
  const TracedMesh traced(generateShape("sphere", 80).mesh);
  const Cone cone = makeCone({.rayCount = kStoredRayCount});
  const VulkanConeKernel kernel(*device, {kStoredRayCount, true});
  const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
  const VulkanHitStoreKernel storeKernel(*device), otherKernel(*other);
  VulkanHitStore store(storeKernel, kStoredRayCount), elsewhere(otherKernel, kStoredRayCount),
      otherRays(storeKernel, 7);
  const std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> values(seeds.size());
  for (VulkanHitStore* const refused : {&elsewhere, &otherRays}) {
    refused->reserve(seeds.size());
    CHECK_THROWS_AS((void)tracer->trace(seeds, {values, {}, refused}, {}), CheckFailure);
  }
  CHECK_THROWS_AS((void)tracer->trace(seeds, {values, {}, &store}, {}), CheckFailure);
  store.reserve(seeds.size());
  CHECK_THROWS_AS((void)makeReferenceTracer(traced.scene(), cone)->trace(seeds, {values, {}, &store}, {}),
                  CheckFailure);
  tracer->trace(seeds, {values, {}, &store}, {});
  CHECK(store.seedCount() == seeds.size());
}
