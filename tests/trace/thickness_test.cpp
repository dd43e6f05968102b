#include "trace/ball_shrinker.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <stop_token>
#include <string>

#include "brute_force.h"
#include "generate/shapes.h"
#include "support/brute_force_thickness.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace/nearest_hit.h"
#include "trace_results.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

/// The thickness of all faces by a tracer, without greatest sections; NaN for degenerate faces and without a wall.
struct Thickness {
  std::vector<double> values, least;
  uint64_t redoneCount = 0;
};

Thickness measure(const TracedMesh& traced, ConeTracer& tracer, double wallAngle = 120) {
  std::vector<FaceBalls> balls;
  for (const uint32_t face : traced.seedFaces()) balls.push_back({face, {}, {}});
  Thickness thickness{std::vector<double>(traced.mesh.faceCount(), kNoValue), {}, 0};
  thickness.least = thickness.values;
  thickness.redoneCount = tracer.makeBallShrinker(makeOpposingWalls(wallAngle))->shrink(balls, {});
  const auto toLength = [&](const InscribedBall& ball) {
    return ball.wall == kNoFace ? kNoValue : traced.scene().bvh.normalization.toMeshLength(ball.ball.diameter);
  };
  for (const FaceBalls& each : balls) {
    thickness.values[each.face] = toLength(each.atBarycentre);
    thickness.least[each.face] = toLength(each.least);
  }
  return thickness;
}

Thickness measureByReference(const TracedMesh& traced, double wallAngle = 120) {
  const Cone cone = makeCone({});
  return measure(traced, *makeReferenceTracer(traced.scene(), cone), wallAngle);
}

void checkThicknessByBruteForce(const std::string& name, const Mesh& mesh, double wallAngle = 120) {
  CAPTURE(name);
  const TracedMesh traced(mesh);
  const Thickness found = measureByReference(traced, wallAngle);
  const test::BruteForceThickness twin(mesh, makeOpposingWalls(wallAngle).cosine,
                                       traced.scene().bvh.normalization.toMeshLength(kMinWallDepth));
  const uint32_t step = std::max(1u, mesh.faceCount() / 150);
  const double tolerance = 1e-6 * traced.geometry.bounds.diagonal();
  int differentCount = 0, valueCount = 0;
  const auto agrees = [&](double expected, double value) {
    return std::isinf(expected) ? std::isnan(value) : std::abs(expected - value) <= tolerance;
  };
  for (uint32_t face = 0; face < mesh.faceCount(); face += step) {
    if (traced.geometry.isDegenerate(face)) continue;
    differentCount += agrees(twin.at(face), found.values[face]) ? 0 : 1;
    differentCount += agrees(twin.least(face), found.least[face]) ? 0 : 1;
    valueCount += std::isnan(found.least[face]) ? 0 : 1;
  }
  CHECK(differentCount == 0);
  CHECK(valueCount > 20);
}

/// Worst difference over the diagonal; infinity where only one has a value.
double worstDifference(const std::vector<double>& a, const std::vector<double>& b, double diagonal) {
  double worst = a.size() == b.size() ? 0 : kNoHit;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    worst = std::isnan(a[i]) || std::isnan(b[i]) ? kNoHit : std::max(worst, std::abs(a[i] - b[i]) / diagonal);
  }
  return worst;
}

Mesh shapeNamed(const char* name, uint64_t faceCount) { return generateShape(name, faceCount).mesh; }

std::vector<Mesh> variousMeshes() {
  return {shapeNamed("animal", 1500),
          shapeNamed("torus", 1200),
          shapes::jittered(shapes::box({1, 2, 3}, 6), 0.02, 2),
          shapes::jittered(shapes::openBox({1, 1, 1}, 6), 0.02, 3),
          shapes::soup(300, 3),
          shapes::shell(1, 0.7)};
}

}  // namespace

TEST_CASE("the reference has the thickness of brute force" * doctest::test_suite("slow")) {
  int index = 0;
  for (const Mesh& mesh : variousMeshes()) checkThicknessByBruteForce(std::to_string(index++), mesh);
  checkThicknessByBruteForce("dented sphere", shapes::jittered(shapes::icosphere(3), 0.05, 1));
  checkThicknessByBruteForce("cylinder", shapes::cylinder(1, 5, 25, 8));
  checkThicknessByBruteForce("hand, 150 degrees", shapeNamed("hand", 1500), 150);
  checkThicknessByBruteForce("hand, 91 degrees", shapeNamed("hand", 1500), 91);
}

TEST_CASE("a slab and a cube have the distance of their walls, edges at a right angle are not thin") {
  for (const Vec3d& size : {Vec3d{4, 4, 1}, Vec3d{2, 2, 2}, Vec3d{3, 1, 0.01}}) {
    const TracedMesh box(shapes::box(size, 7));
    const std::vector<double> values = measureByReference(box).values;
    for (uint32_t face = 0; face < box.mesh.faceCount(); ++face) {
      const Vec3d& n = box.geometry.normals[face];
      const double expected = std::abs(n.x) > 0.5 ? size.x : std::abs(n.y) > 0.5 ? size.y : size.z;
      CHECK(values[face] == doctest::Approx(expected).epsilon(1e-12));
    }
  }
}

TEST_CASE("spheres, cylinders and tori approach their diameters as the mesh becomes finer" *
          doctest::test_suite("slow")) {
  const auto worstOf = [](const Mesh& mesh, double diameter, double greatestHeight) {
    const TracedMesh traced(mesh);
    const std::vector<double> values = measureByReference(traced).values;
    double worst = 0;
    for (uint32_t face = 0; face < mesh.faceCount(); ++face)
      if (std::abs(traced.geometry.barycentres[face].z) < greatestHeight)
        worst = std::max(worst, std::abs(values[face] / diameter - 1));
    return worst;
  };
  CHECK(worstOf(shapes::icosphere(2, 3), 6, 10) < 0.06);
  CHECK(worstOf(shapes::icosphere(4, 3), 6, 10) < 0.06 / 10);
  // First order: barycentres are not in the middle of their sides, and a ball touches walls at 120 degrees.
  CHECK(worstOf(shapes::cylinder(0.5, 10, 16, 41), 1, 1) < 0.06);
  CHECK(worstOf(shapes::cylinder(0.5, 10, 64, 41), 1, 1) < 0.06 / 3.9);
  CHECK(worstOf(makeTorus(500).mesh, 0.6, 10) < 0.2);
  CHECK(worstOf(makeTorus(4000).mesh, 0.6, 10) < 0.2 / 2.5);
}

TEST_CASE("a wedge is as thin as the ball between its walls, from the angle of the walls on") {
  // Two wide walls at 40 degrees to each other that meet at x = 0: their normals differ by 140 degrees.
  const double half = 20 * std::acos(-1.0) / 180, w = 100;
  Mesh mesh{{{0, -w, 0},
             {0, w, 0},
             {w, -w, w * std::tan(half)},
             {w, w, w * std::tan(half)},
             {w, -w, -w * std::tan(half)},
             {w, w, -w * std::tan(half)}},
            {{0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 1, 5}},
            {}};
  const TracedMesh wedge(mesh);
  const std::vector<double> values = measureByReference(wedge).values;
  for (uint32_t face = 0; face < 4; ++face) {
    // Along a wall, at the distance d from the edge, the ball has the radius d tan(20 degrees).
    const Vec3d& c = wedge.geometry.barycentres[face];
    CHECK(values[face] == doctest::Approx(2 * std::hypot(c.x, c.z) * std::tan(half)).epsilon(1e-9));
  }
  for (const double value : measureByReference(wedge, 150).values) CHECK(std::isnan(value));
}

TEST_CASE("the rim of a plate is as thick as the plate is wide, which no ray of a cone would find") {
  const TracedMesh plate(shapes::box({10, 10, 0.1}, 1));
  const Thickness thickness = measureByReference(plate);
  for (uint32_t face = 0; face < plate.mesh.faceCount(); ++face)
    CHECK(thickness.values[face] == doctest::Approx(std::abs(plate.geometry.normals[face].z) > 0.5 ? 0.1 : 10));
}

TEST_CASE("meshes of one face, two faces, needles, copies and none have a thickness or none, without failure") {
  const Mesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  CHECK(std::isnan(measureByReference(TracedMesh(one)).values[0]));
  // The same face twice, in both windings: the copies are one face.
  const TracedMesh twice(Mesh{one.vertices, {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}}, {}});
  for (const double value : measureByReference(twice).values) CHECK(std::isnan(value));
  // Two faces that face away from each other, 0.25 apart.
  const TracedMesh two(shapes::joined(shapes::scaledAndShifted(one, 1, {0, 0, 0.25}), shapes::inverted(one)));
  for (const double value : measureByReference(two).values) CHECK(value == doctest::Approx(0.25));
  Mesh needles = shapes::soup(200, 9);
  for (Vec3d& v : needles.vertices) v.x *= 1e-7;
  for (const double value : measureByReference(TracedMesh(needles)).values) CHECK((std::isnan(value) || value >= 0));
  Mesh doubled = shapes::joined(shapes::icosphere(2), shapes::icosphere(2));
  for (size_t i = doubled.faces.size() / 2; i < doubled.faces.size(); ++i)
    doubled.faces[i] = doubled.faces[i - doubled.faces.size() / 2];
  const std::vector<double> values = measureByReference(TracedMesh(doubled)).values;
  const std::vector<double> single = measureByReference(TracedMesh(shapes::icosphere(2))).values;
  for (size_t i = 0; i < values.size(); ++i) CHECK(values[i] == single[i % single.size()]);
}

TEST_CASE("scaling by a power of two changes no bit, shifts and other scales only the last digits") {
  const Mesh mesh = shapes::jittered(shapes::icosphere(2), 0.05, 5);
  const std::vector<double> values = measureByReference(TracedMesh(mesh)).values;
  std::vector<double> scaled = measureByReference(TracedMesh(shapes::scaledAndShifted(mesh, 0x1p-10, {}))).values;
  for (double& value : scaled) value *= 0x1p10;
  CHECK(test::haveSameBits(values, scaled));
  for (const double scale : {1e-3, 1e3}) {
    const std::vector<double> moved =
        measureByReference(TracedMesh(shapes::scaledAndShifted(mesh, scale, {10 * scale, 0, -3 * scale}))).values;
    for (size_t i = 0; i < values.size(); ++i) CHECK(moved[i] / scale == doctest::Approx(values[i]).epsilon(1e-9));
  }
}

TEST_CASE("any number of threads gives the same bits") {
  const TracedMesh traced(shapeNamed("animal", 4000));
  std::vector<double> expected;
  for (const size_t threads : {1u, 3u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<double> values = measureByReference(traced).values;
    if (expected.empty()) expected = values;
    CHECK(test::haveSameBits(values, expected));
  }
}

TEST_CASE("Embree has the reference's thickness") {
  if (!hasEmbree()) return;
  for (const Mesh& mesh : variousMeshes()) {
    const TracedMesh traced(mesh);
    const Cone cone = makeCone({});
    const Thickness found = measure(traced, *makeEmbreeTracer(traced.scene(), cone));
    CHECK(worstDifference(found.values, measureByReference(traced).values, traced.geometry.bounds.diagonal()) < 1e-6);
  }
}

TEST_CASE("the kernel has the reference's thickness, in every variant" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  for (const Mesh& mesh : variousMeshes()) {
    const TracedMesh traced(mesh);
    const Cone cone = makeCone({});
    const std::vector<double> expected = measureByReference(traced).values;
    for (const BvhLayout bvh : {BvhLayout::Binary, BvhLayout::Wide})
      for (const BvhFetch fetch : {BvhFetch::Storage, BvhFetch::Texel}) {
        CAPTURE(static_cast<int>(bvh));
        CAPTURE(static_cast<int>(fetch));
        const VulkanConeKernel kernel(*device, {.rayCount = 30,
                                                .writesHits = true,
                                                .choice = VulkanTraceChoice{TraceKernel::Seed, bvh, fetch},
                                                .shrinksBalls = true});
        const Thickness found = measure(traced, *makeVulkanTracer(kernel, traced.scene(), cone));
        CHECK(worstDifference(found.values, expected, traced.geometry.bounds.diagonal()) < 1e-5);
        CHECK(found.redoneCount * 20 <= expected.size());
      }
  }
}

TEST_CASE("a hierarchy beyond the texel limit of a device is measured with storage and refused with texels" *
          doctest::test_suite("slow")) {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxTexelBufferElements = 100;
  facts.maxStorageBuffersPerStage = 4;  // The least that Vulkan allows.
  const Device small(physical, facts);
  const TracedMesh traced(shapeNamed("torus", 1200));
  const Cone cone = makeCone({});
  const auto kernelFor = [&](BvhFetch fetch) {
    return VulkanConeKernel(small, {.rayCount = 30,
                                    .writesHits = true,
                                    .choice = VulkanTraceChoice{TraceKernel::Ray, BvhLayout::Wide, fetch},
                                    .shrinksBalls = true});
  };
  const VulkanConeKernel storage = kernelFor(BvhFetch::Storage), texels = kernelFor(BvhFetch::Texel);
  const Thickness found = measure(traced, *makeVulkanTracer(storage, traced.scene(), cone));
  CHECK(worstDifference(found.values, measureByReference(traced).values, traced.geometry.bounds.diagonal()) < 1e-5);
  CHECK_THROWS_WITH_AS((void)makeVulkanTracer(texels, traced.scene(), cone), doctest::Contains("texels in one buffer"),
                       Error);
}

TEST_CASE("balls beyond the limits of the device are shrunk by the reference") {
  const test::ValidatedDevice device;
  const Cone cone = makeCone({});
  const VulkanConeKernel kernel(*device, {.rayCount = 30, .writesHits = true, .shrinksBalls = true});
  // Thinner than float32 resolves.
  const TracedMesh sheet(shapes::box({1, 1, 2e-5}, 8));
  const Thickness thin = measure(sheet, *makeVulkanTracer(kernel, sheet.scene(), cone));
  CHECK(thin.redoneCount >= 256);
  const std::vector<double> expected = measureByReference(sheet).values;
  for (size_t i = 0; i < expected.size(); ++i) CHECK(thin.values[i] == doctest::Approx(expected[i]).epsilon(1e-9));
}
