// Parts that touch have the values of the same parts moved apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "random_solids/assembly.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace/nearest_hit.h"
#include "trace_results.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

struct Assembly {
  TracedMesh touching;
  std::vector<double> expected;

  Assembly(Mesh parts, const Mesh& apart)
      : touching(std::move(parts)), expected(traceByReference(TracedMesh(apart), {}, Wanted::Values).values) {}

  explicit Assembly(uint64_t seed)
      : Assembly(makeAssembly({.seed = seed}).mesh, makeAssembly({.seed = seed, .apart = 1.0}).mesh) {}
};

Assembly stackedBoxes(const Vec3d& shift, uint32_t upperSide) {
  const Mesh lower = shapes::box({2, 2, 2}, 4), upper = shapes::box({2, 2, 2}, upperSide);
  return {shapes::joined(lower, upper, shift), shapes::joined(lower, upper, 3.0 * shift)};
}

/// The sides of the pin are so narrow that weights of their corners are inexact in float32.
Assembly pinInBlock() {
  const Mesh pin = shapes::cylinder(0.3, 2, 256, 1);
  const Mesh block = shapes::joined(shapes::box({1, 1, 2.5}), shapes::inverted(pin));
  return {shapes::joined(block, pin), shapes::joined(block, pin, {4, 0, 0})};
}

std::vector<Assembly> assemblies() {
  std::vector<Assembly> result;
  for (uint64_t seed = 1; seed <= 6; ++seed) result.emplace_back(seed);
  result.push_back(stackedBoxes({0, 0, 2}, 4));  // The faces in contact have the same corners.
  result.push_back(stackedBoxes({0, 0, 2}, 3));
  result.push_back(stackedBoxes({0.7, 2, 0.3}, 5));
  result.push_back(pinInBlock());
  return result;
}

/// Faces without the value of the parts apart, to 1e-3 of it.
size_t wrongCount(const std::vector<double>& values, const std::vector<double>& expected) {
  REQUIRE(values.size() == expected.size());
  size_t count = 0;
  for (size_t i = 0; i < values.size(); ++i)
    count += std::abs(values[i] - expected[i]) <= 1e-3 * expected[i] || std::isnan(values[i] + expected[i]) ? 0 : 1;
  return count;
}

}  // namespace

TEST_CASE("parts that touch have the values of the same parts apart, on every backend") {
  const test::ValidatedDevice device;
  const std::vector<Assembly> touching = assemblies();
  const auto check = [](const Assembly& assembly, const TraceResults& results) {
    CAPTURE(assembly.expected.size());
    CHECK(wrongCount(results.values, assembly.expected) <= assembly.expected.size() / 500);
  };
  const Cone cone = makeCone({});
  for (const Assembly& assembly : touching) {
    const TracedMesh& traced = assembly.touching;
    check(assembly, traceByReference(traced, {}, Wanted::Values));
    check(assembly, traceAll(*makeCpuTracer(traced.scene(), cone), traced, 30, Wanted::Values));
  }
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {30, false, choice});
    for (const Assembly& assembly : touching)
      check(assembly, traceByKernel(kernel, assembly.touching, {}, Wanted::Values));
  });
}

TEST_CASE("a ray leaves its own part before it enters the next one, and does not see what it starts on") {
  const TracedMesh traced(shapes::joined(shapes::box({2, 2, 2}), shapes::box({1, 1, 2}), {0.3, 0.2, 2}));
  const double contact = makeCone({}).contactDistance, scale = traced.bvh.normalization.scale;
  const Vec3d up{0, 0, 1}, low = traced.bvh.normalization.toNormalized({0.1, 0.2, -0.5}), way = 1.5 * scale * up;
  const RayHit leaving = nearestHit(traced.bvh, traced.mesh, low, up, kNoFace, contact);
  REQUIRE(leaving.face != kNoFace);
  CHECK(leaving.face < 12);
  CHECK(leaving.distance == doctest::Approx(1.5 * scale));
  for (const double distance : {0.0, 0.5 * contact, -0.5 * contact}) {
    const Vec3d origin = low + way + distance * up;
    CHECK(nearestHit(traced.bvh, traced.mesh, origin, -up, kNoFace, contact).distance == doctest::Approx(2 * scale));
    CHECK(nearestHit(traced.bvh, traced.mesh, origin, up, kNoFace, contact).distance == doctest::Approx(2 * scale));
  }
  CHECK(nearestHit(traced.bvh, traced.mesh, low + way - 2 * contact * up, up, kNoFace, contact).distance ==
        doctest::Approx(2 * contact));
}
