#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "generate/shapes.h"
#include "hit_checks.h"
#include "hit_comparison.h"
#include "support/bits.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace/seed_order.h"
#include "trace/vk/vulkan_tracer.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

struct Traced {
  std::vector<double> values;
  std::vector<ConeHit> hits;
};

Traced traceFaces(ConeTracer& tracer, std::span<const uint32_t> faces, size_t rayCount) {
  Traced traced{std::vector<double>(faces.size()), std::vector<ConeHit>(faces.size() * rayCount)};
  tracer.trace(faces, {traced.values, traced.hits}, {});
  return traced;
}

Traced traceStarts(ConeTracer& tracer, std::span<const ConeStart> starts, size_t rayCount) {
  Traced traced{std::vector<double>(starts.size()), std::vector<ConeHit>(starts.size() * rayCount)};
  const TraceStatistics statistics = tracer.traceAt(starts, {traced.values, traced.hits}, {});
  CHECK(statistics.rayCount == starts.size() * rayCount);
  return traced;
}

/// The cones of the faces as starts; their hits and values are those of the faces.
void checkStartsOfFaces(ConeTracer& tracer, const TracedMesh& traced, const Cone& cone, size_t allowedCount) {
  const std::vector<uint32_t> faces = traced.seedFaces();
  std::vector<ConeStart> starts;
  for (const uint32_t face : faces) starts.push_back(coneStartOfFace(traced.scene(), cone, face));
  const Traced ofFaces = traceFaces(tracer, faces, cone.directions.size());
  const Traced ofStarts = traceStarts(tracer, starts, cone.directions.size());
  size_t differingCount = 0;
  for (size_t i = 0; i < faces.size(); ++i) {
    const double a = ofFaces.values[i], b = ofStarts.values[i];
    differingCount += std::isnan(a) ? !std::isnan(b) : !(std::abs(a - b) <= 1e-6 * a);
  }
  CHECK(differingCount <= allowedCount);
  CHECK(differingRays(ofFaces.hits, ofStarts.hits) <= allowedCount * cone.directions.size());
}

}  // namespace

TEST_CASE("the reference and all Vulkan variants give the cones of faces the values of the faces" *
          doctest::test_suite("slow")) {
  const TracedMesh traced(makeTorus(600).mesh);
  test::ValidatedDevice device;
  for (const Definition definition : {Definition::Paper, Definition::Cgal}) {
    ConeOptions options;
    options.definition = definition;
    const Cone cone = makeCone(options);
    checkStartsOfFaces(*makeReferenceTracer(traced.scene(), cone), traced, cone, 0);
    forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
      const VulkanConeKernel kernel(*device, {options.rayCount, true, choice, definition});
      checkStartsOfFaces(*makeVulkanTracer(kernel, traced.scene(), cone), traced, cone, 0);
    });
  }
}

TEST_CASE("all tracers agree on cones inside and around a mesh") {
  const TracedMesh traced(shapes::jittered(shapes::torus(1, 0.4, 40, 20), 0.01, 2));
  Random random(3);
  const auto within = [&](double limit) { return limit * (2 * random.real() - 1); };
  const Cone cone = makeCone({});
  std::vector<ConeStart> starts;
  for (int i = 0; i < 500; ++i) {
    const double limit = i % 5 == 0 ? 3 : 0.9;  // A part is far from the box.
    const Vec3d normal{within(1), within(1), within(1)};
    starts.push_back(coneStartAt(cone, {within(limit), within(limit), within(0.4 * limit)}, normal / length(normal)));
  }
  const size_t rayCount = cone.directions.size();
  const Traced expected = traceStarts(*makeReferenceTracer(traced.scene(), cone), starts, rayCount);
  const auto check = [&](ConeTracer& tracer) {
    const Traced result = traceStarts(tracer, starts, rayCount);
    size_t differingCount = 0;
    for (size_t i = 0; i < starts.size(); ++i) {
      const double a = expected.values[i], b = result.values[i];
      differingCount += std::isnan(a) || std::isnan(b) ? std::isnan(a) != std::isnan(b) : !(std::abs(a - b) <= 1e-5);
    }
    CHECK(differingCount <= 3);
    CHECK(differingRays(result.hits, expected.hits) <= 20);
  };
  check(*makeCpuTracer(traced.scene(), cone));
  test::ValidatedDevice device;
  const VulkanConeKernel kernel(*device, {30, true});
  check(*makeVulkanTracer(kernel, traced.scene(), cone));
}

TEST_CASE("the spatial order is a permutation in which neighbours are close") {
  Random random(5);
  std::vector<ConeStart> starts(4096);
  for (ConeStart& start : starts) start.origin = {2 * random.real() - 1, 2 * random.real() - 1, 2 * random.real() - 1};
  starts[7].origin = {1e300, -1e300, 5};
  const std::vector<uint32_t> order = spatialOrder(starts);
  std::vector<uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (uint32_t i = 0; i < sorted.size(); ++i) REQUIRE(sorted[i] == i);
  const auto meanStep = [&](const std::vector<uint32_t>& indices) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 1; i < indices.size(); ++i) {
      if (indices[i] == 7 || indices[i - 1] == 7) continue;
      sum += length(starts[indices[i]].origin - starts[indices[i - 1]].origin);
      ++count;
    }
    return sum / static_cast<double>(count);
  };
  CHECK(meanStep(order) < 0.25 * meanStep(sorted));
}
