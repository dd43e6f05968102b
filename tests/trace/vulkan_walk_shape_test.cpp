// The settings of the traversal that differ between classes of devices. All of them run on the device of the tests.
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <utility>

#include "generate/shapes.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace_results.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

constexpr ConeKernelRequest requestFor(TraceKernel kernel) { return {30, true, VulkanTraceChoice{kernel}}; }

TraceResults traceWith(const Device& device, TraceKernel kernel, const VulkanWalkShape& walk,
                       const TracedMesh& traced) {
  const VulkanConeKernel compiled(device, requestFor(kernel), {}, walk);
  return traceByKernel(compiled, traced, {}, Wanted::ValuesAndHits);
}

bool haveSameHits(const std::vector<ConeHit>& a, const std::vector<ConeHit>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(ConeHit)) == 0;
}

}  // namespace

TEST_CASE("long stacks and triangles that are not postponed give the same bits" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const VulkanWalkShape other{.stackSize = 65, .postponesTriangles = false};
  for (const TraceKernel kernel : {TraceKernel::Ray, TraceKernel::Seed}) {
    CAPTURE(static_cast<int>(kernel));
    const TraceResults expected = traceWith(*device, kernel, VulkanWalkShape{}, traced);
    const TraceResults results = traceWith(*device, kernel, other, traced);
    CHECK(results.statistics.redoneConeCount == 0);
    CHECK(test::haveSameBits(results.values, expected.values));
  }
}

TEST_CASE("a hierarchy of more levels than the stack has entries is traced with a larger stack") {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 3000).mesh);
  const uint32_t depth = encodeWideBvh(traced.bvh).depth;
  REQUIRE(depth > 2);
  for (const TraceKernel kernel : {TraceKernel::Ray, TraceKernel::Seed, TraceKernel::Packet}) {
    CAPTURE(static_cast<int>(kernel));
    const TraceResults expected = traceWith(*device, kernel, {}, traced);
    for (const uint32_t stackSize : {1u, depth}) {
      CAPTURE(stackSize);
      CHECK(haveSameHits(traceWith(*device, kernel, {.stackSize = stackSize}, traced).hits, expected.hits));
    }
  }
}

TEST_CASE("each kernel has one pipeline for all hierarchies within its stack, and one for all others") {
  const test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, requestFor(TraceKernel::Seed), {}, VulkanWalkShape{.stackSize = 8});
  CHECK(&kernel.rays(0) == &kernel.rays(8));
  CHECK(&kernel.rays(9) != &kernel.rays(8));
  CHECK(&kernel.rays(9) == &kernel.rays(kMaxBvhDepth));
  const VulkanConeKernel packets(*device, requestFor(TraceKernel::Packet), {}, VulkanWalkShape{.stackSize = 8});
  CHECK(&packets.rays(0) == &packets.rays(kMaxBvhDepth));
}

TEST_CASE("each arithmetic of nodes gives the values of the reference") {
  const test::ValidatedDevice device;
  const std::pair<const char*, Mesh> meshes[]{{"animal", generateShape("animal", 3000).mesh},
                                              {"flat box", shapes::box({2, 3, 0.01}, 10)},
                                              {"soup", shapes::soup(2000, 5)},
                                              {"needle", shapes::box({1e-4, 1e-4, 2}, 6)}};
  for (const auto& each : meshes) {
    CAPTURE(each.first);
    const TracedMesh traced(each.second);
    const TraceResults reference = traceByReference(traced, {}, Wanted::ValuesAndHits);
    const TraceResults masked =
        traceWith(*device, TraceKernel::Seed, {.arithmetic = NodeArithmetic::MaskedBytes}, traced);
    const TraceResults shifted =
        traceWith(*device, TraceKernel::Seed, {.arithmetic = NodeArithmetic::ShiftedBytes}, traced);
    const TraceResults mantissa =
        traceWith(*device, TraceKernel::Seed, {.arithmetic = NodeArithmetic::MantissaBytes}, traced);
    CHECK(haveSameHits(shifted.hits, masked.hits));
    CHECK(haveSameHits(mantissa.hits, masked.hits));
    for (const TraceResults* results : {&masked, &shifted, &mantissa})
      CHECK(differingCount(results->values, reference.values, traced.geometry.bounds.diagonal()) <=
            reference.values.size() / 1000);
  }
}

TEST_CASE("packets run with the arithmetic of GPUs" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const TraceResults expected = traceWith(*device, TraceKernel::Packet, {}, traced);
  for (const NodeArithmetic arithmetic : {NodeArithmetic::ShiftedBytes, NodeArithmetic::MantissaBytes}) {
    CAPTURE(static_cast<uint32_t>(arithmetic));
    const TraceResults results = traceWith(*device, TraceKernel::Packet, {.arithmetic = arithmetic}, traced);
    CHECK(test::haveSameBits(results.values, expected.values));
  }
}
