#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>

#include "asdf_vk/error.h"
#include "generate/shapes.h"
#include "hit_comparison.h"
#include "support/counted_memory.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace_results.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

/// Values and hits of a batch of seeds, in which faces may occur repeatedly.
TraceResults traceFaces(ConeTracer& tracer, std::span<const uint32_t> faces, uint32_t rayCount, Wanted wanted) {
  TraceResults results{std::vector<double>(faces.size()), {}, {}};
  if (wanted == Wanted::ValuesAndHits) results.hits.resize(faces.size() * rayCount, {-1, 0});
  results.statistics = tracer.trace(faces, {results.values, results.hits}, {});
  return results;
}

}  // namespace

TEST_CASE("memory that the host cannot map changes no bit" * doctest::test_suite("slow")) {
  const test::ValidatedDevice mapped;
  const auto separate = test::ValidatedDevice::changed(test::useSeparateMemory);
  const TracedMesh traced(generateShape("animal", 1200).mesh);
  forEveryVariant(Fetches::All, [&](const VulkanTraceChoice& choice) {
    const ConeKernelRequest request{30, true, choice};
    const VulkanConeKernel expected(*mapped, request), kernel(*separate, request);
    for (const Wanted wanted : {Wanted::Values, Wanted::ValuesAndHits}) {
      const TraceResults a = traceByKernel(expected, traced, {}, wanted), b = traceByKernel(kernel, traced, {}, wanted);
      CHECK(test::haveSameBits(a.values, b.values));
      CHECK(test::haveSameBits(a.hits, b.hits));
    }
  });
}

TEST_CASE("all numbers of rays and both definitions run on memory that the host cannot map" *
          doctest::test_suite("slow")) {
  const auto separate = test::ValidatedDevice::changed(test::useSeparateMemory);
  const TracedMesh traced(shapes::jittered(shapes::icosphere(1), 0.02, 3));
  for (const uint32_t rayCount : {1u, 33u, 1024u}) {
    for (const Definition definition : {Definition::Paper, Definition::Cgal}) {
      CAPTURE(rayCount);
      const ConeOptions options{.rayCount = rayCount, .definition = definition};
      const VulkanConeKernel kernel(*separate, {rayCount, true, {}, definition});
      const TraceResults results = traceByKernel(kernel, traced, options, Wanted::ValuesAndHits);
      const TraceResults expected = traceByReference(traced, options, Wanted::ValuesAndHits);
      CHECK(differingCount(results.values, expected.values, traced.geometry.bounds.diagonal()) == 0);
      CHECK(differingRays(results.hits, expected.hits) <= results.hits.size() / 1000);
    }
  }
}

TEST_CASE("small chunks, one seed and repeated seeds have the values of the whole") {
  const TracedMesh traced(generateShape("hand", 1500).mesh);
  const Cone cone = makeCone({});
  const auto check = [&](const Device& device, const ConeKernelRequest& request, const TraceResults& expected) {
    const VulkanConeKernel kernel(device, request);
    const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
    const TraceResults all = traceAll(*tracer, traced, 30, Wanted::ValuesAndHits);
    CHECK(test::haveSameBits(all.values, expected.values));
    CHECK(test::haveSameBits(all.hits, expected.hits));
    std::vector<uint32_t> repeated;
    for (uint32_t i = 0; i < 500; ++i) repeated.push_back(traced.seedFaces()[(i * 7) % 40]);
    for (const std::span<const uint32_t> faces :
         {std::span<const uint32_t>(repeated).first(1), std::span<const uint32_t>(repeated)}) {
      const TraceResults some = traceFaces(*tracer, faces, 30, Wanted::ValuesAndHits);
      for (size_t i = 0; i < faces.size(); ++i) {
        const size_t face = (i * 7) % 40;
        REQUIRE(some.values[i] == expected.values[face]);
        REQUIRE(test::haveSameBits(std::vector(&some.hits[30 * i], &some.hits[30 * i] + 30),
                                   std::vector(&expected.hits[30 * face], &expected.hits[30 * face] + 30)));
      }
    }
    CHECK(traceFaces(*tracer, {}, 30, Wanted::ValuesAndHits).values.empty());
  };
  const test::ValidatedDevice whole;
  const auto useSmallChunks = [](DeviceFacts& facts) { facts.maxStorageBufferRange = 101 * 30 * sizeof(ConeHit); };
  const auto mapped = test::ValidatedDevice::changed(useSmallChunks),
             separate = test::ValidatedDevice::changed([&](DeviceFacts&facts) {
               useSmallChunks(facts);
               test::useSeparateMemory(facts);
             });
  for (const auto& [name, kernel] : kKernels) {
    const ConeKernelRequest request{30, true, VulkanTraceChoice{kernel, BvhFetch::Texel}};
    const TraceResults expected = traceByKernel(VulkanConeKernel(*whole, request), traced, {}, Wanted::ValuesAndHits);
    for (const Device* device : {&*whole, &*mapped, &*separate}) check(*device, request, expected);
  }
}

TEST_CASE("copies of faces with the opposite normal have the reference's values") {
  const test::ValidatedDevice device;
  Mesh mesh = shapes::jittered(shapes::icosphere(2), 0.05, 4);
  const size_t count = mesh.faces.size();
  for (size_t f = 0; f < count; f += 3) mesh.faces.push_back({mesh.faces[f][1], mesh.faces[f][0], mesh.faces[f][2]});
  const TracedMesh traced(shapes::joined(mesh, shapes::scaledAndShifted(shapes::icosphere(2), 3, {0, 0, 0})));
  // Each face has at most one copy among the seeds, so that there are many seeds without repeated triangles.
  std::vector<uint32_t> distinct(count);
  for (uint32_t f = 0; f < count; ++f) distinct[f] = f % 3 == 0 ? static_cast<uint32_t>(count) + f / 3 : f;
  for (const ConeRotation rotation : {ConeRotation::Fixed, ConeRotation::Hashed}) {
    const ConeOptions options{.rotation = rotation};
    const std::vector<double> expected = traceByReference(traced, options, Wanted::Values).values;
    forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
      const VulkanConeKernel kernel(*device, {30, false, choice});
      const std::vector<double> values = traceByKernel(kernel, traced, options, Wanted::Values).values;
      CHECK(differingCount(values, expected, traced.geometry.bounds.diagonal()) == 0);
      const Cone cone = makeCone(options);
      const std::vector<double> some =
          traceFaces(*makeVulkanTracer(kernel, traced.scene(), cone), distinct, 30, Wanted::Values).values;
      for (size_t i = 0; i < distinct.size(); ++i) REQUIRE(some[i] == values[distinct[i]]);
    });
  }
}

TEST_CASE("the memory of a trace is bounded by the number of seeds and serves later meshes") {
  const TracedMesh cube(shapes::box({1, 1, 1}, 1));
  REQUIRE(cube.mesh.faces.size() == 12);
  const auto mapped = test::ValidatedDevice::changed([](DeviceFacts&) {}),
             separate = test::ValidatedDevice::changed(test::useSeparateMemory);
  for (const Device* device : {&*mapped, &*separate}) {
    const VulkanConeKernel kernel(*device, {30, true});
    const test::CountedMemory counted;
    (void)traceByKernel(kernel, cube, {}, Wanted::ValuesAndHits);
    CHECK(counted.byteCount() <= (2u << 20));
    const uint64_t first = counted.allocationCount();
    (void)traceByKernel(kernel, cube, {}, Wanted::ValuesAndHits);
    CHECK(counted.allocationCount() - first <= 5);  // Nodes, triangles, rays, two placeholders: those of the mesh.
  }
}

TEST_CASE("a stop ends a trace while chunks are in flight, and the tracer serves later ones") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {30});
  const TracedMesh traced(generateShape("torus", 30'000).mesh);
  const Cone cone = makeCone({});
  const auto tracer = makeVulkanTracer(kernel, traced.scene(), cone);
  const std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> values(seeds.size()), again(100), expected(100);
  std::stop_source stop;
  using Clock = std::chrono::steady_clock;
  Clock::time_point requested;
  const RunControl control{stop.get_token(), [&](double fraction) {
                             if (fraction > 0.2 && !stop.stop_requested()) {
                               requested = Clock::now();
                               stop.request_stop();
                             }
                           }};
  CHECK_THROWS_AS((void)tracer->trace(seeds, {values}, control), Error);
  // On an idle machine this takes 0.1 s. The limit is for a busy machine.
  CHECK(std::chrono::duration<double>(Clock::now() - requested).count() < 2);
  tracer->trace(std::span(seeds).first(100), {again}, {});
  makeReferenceTracer(traced.scene(), cone)->trace(std::span(seeds).first(100), {expected}, {});
  CHECK(differingCount(again, expected, traced.geometry.bounds.diagonal()) == 0);
}
