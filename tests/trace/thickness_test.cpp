#include "trace/thickness_tracer.h"

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

/// The thickness of all faces by a tracer; NaN for degenerate ones.
struct Thickness {
  std::vector<double> values;
  ThicknessStatistics statistics;
};

Thickness measure(const TracedMesh& traced, ConeTracer& tracer, const Cone& cone, double wallAngle = 120) {
  const std::vector<uint32_t> seeds = traced.seedFaces();
  const TraceResults results = traceAll(tracer, traced, cone.directions.size(), Wanted::ValuesAndHits);
  const OpposingWalls walls = makeOpposingWalls(wallAngle);
  std::vector<double> values(seeds.size());
  const ThicknessStatistics statistics =
      measureThickness(traced.scene(), cone, walls, {seeds, results.hits}, *tracer.makeBallShrinker(walls), values, {});
  Thickness thickness{std::vector<double>(traced.mesh.faceCount(), kNoValue), statistics};
  for (size_t i = 0; i < seeds.size(); ++i) thickness.values[seeds[i]] = values[i];
  return thickness;
}

Thickness measureByReference(const TracedMesh& traced, double wallAngle = 120, const ConeOptions& options = {}) {
  const Cone cone = makeCone(options);
  return measure(traced, *makeReferenceTracer(traced.scene(), cone), cone, wallAngle);
}

/// By all faces against each ray and each ball.
double bruteForce(const Mesh& mesh, const test::BruteForceThickness& balls, const Cone& cone, uint32_t face) {
  Cone axis = cone;
  axis.directions = {{0, 0, 1}};
  axis.weights = {1};
  double opposing = kNoHit, valid = kNoHit;
  for (const Cone* rays : {&cone, static_cast<const Cone*>(&axis)}) {
    const BruteForceCone traced = traceByBruteForce(mesh, *rays, face);
    for (size_t i = 0; i < rays->directions.size(); ++i) {
      const double diameter = traced.hitDistances[i] / rays->directions[i].z;
      if (traced.hitFaces[i] == kNoFace) continue;
      if (balls.isOpposing(face, traced.hitFaces[i])) opposing = std::min(opposing, diameter);
      if (!std::isnan(traced.rayLengths[i])) valid = std::min(valid, diameter);
    }
  }
  if (opposing < kNoHit) return balls.of(face, opposing);
  return valid < kNoHit ? valid : kNoValue;
}

void checkThicknessByBruteForce(const std::string& name, const Mesh& mesh, double wallAngle = 120) {
  CAPTURE(name);
  const TracedMesh traced(mesh);
  const Thickness found = measureByReference(traced, wallAngle);
  const Cone cone = makeCone({});
  const test::BruteForceThickness balls(mesh, makeOpposingWalls(wallAngle).cosine);
  const uint32_t step = std::max(1u, mesh.faceCount() / 150);
  const double tolerance = 1e-6 * traced.geometry.bounds.diagonal();
  int differentCount = 0, valueCount = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); face += step) {
    if (traced.geometry.isDegenerate(face)) continue;
    const double expected = bruteForce(mesh, balls, cone, face), value = found.values[face];
    const bool agrees = std::isnan(expected) ? std::isnan(value) : std::abs(expected - value) <= tolerance;
    differentCount += agrees ? 0 : 1;
    valueCount += std::isnan(value) ? 0 : 1;
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
  const Thickness narrow = measureByReference(wedge, 150);
  CHECK(narrow.statistics.unrefinedCount == 4);
}

TEST_CASE("the rim of a plate is as thick as the plate is wide: only the ray along the axis hits the opposite rim") {
  const TracedMesh plate(shapes::box({10, 10, 0.1}, 1));
  const Thickness thickness = measureByReference(plate);
  CHECK(thickness.statistics.unrefinedCount == 0);
  for (uint32_t face = 0; face < plate.mesh.faceCount(); ++face)
    CHECK(thickness.values[face] == doctest::Approx(std::abs(plate.geometry.normals[face].z) > 0.5 ? 0.1 : 10));
}

TEST_CASE("without an opposing wall the least ray counts, without a valid hit there is no value") {
  // A pyramid of five faces without opposing walls at 150 degrees.
  const Mesh pyramid{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 2}},
                     {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                     {}};
  checkThicknessByBruteForce(
      "pyramid", shapes::joined(pyramid, shapes::scaledAndShifted(shapes::icosphere(1), 0.3, {9, 0, 0})), 175);
  const TracedMesh traced(pyramid);
  CHECK(measureByReference(traced, 175).statistics.unrefinedCount == 6);
  const TracedMesh inverted(shapes::inverted(shapes::icosphere(1)));
  for (const double value : measureByReference(inverted).values) CHECK(std::isnan(value));
}

TEST_CASE("a stop while the first balls are found ends the measurement before any ball shrinks") {
  struct CountingShrinker final : BallShrinker {
    int callCount = 0;
    uint64_t shrink(std::span<InscribedBall>, const RunControl&) override {
      ++callCount;
      return 0;
    }
  };
  const TracedMesh sphere(shapes::icosphere(4));  // More faces than the first chunk has.
  const Cone cone = makeCone({});
  const std::vector<uint32_t> seeds = sphere.seedFaces();
  const std::vector<ConeHit> hits(seeds.size() * cone.directions.size(), kMiss);
  std::vector<double> values(seeds.size());
  std::stop_source stop;
  std::vector<double> fractions;
  const RunControl control{stop.get_token(), [&](double fraction) {
                             fractions.push_back(fraction);
                             if (fraction > 0) stop.request_stop();
                           }};
  CountingShrinker shrinker;
  try {
    (void)measureThickness(sphere.scene(), cone, makeOpposingWalls(120), {seeds, hits}, shrinker, values, control);
    FAIL("the measurement was not cancelled");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
  CHECK(shrinker.callCount == 0);
  REQUIRE(fractions.size() == 2);
  CHECK(fractions[1] < 0.2);
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
    const Thickness found = measure(traced, *makeEmbreeTracer(traced.scene(), cone), cone);
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
        const Thickness found = measure(traced, *makeVulkanTracer(kernel, traced.scene(), cone), cone);
        CHECK(worstDifference(found.values, expected, traced.geometry.bounds.diagonal()) < 1e-5);
        CHECK(found.statistics.redoneBallCount * 20 <= expected.size());
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
  const Thickness found = measure(traced, *makeVulkanTracer(storage, traced.scene(), cone), cone);
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
  const Thickness thin = measure(sheet, *makeVulkanTracer(kernel, sheet.scene(), cone), cone);
  CHECK(thin.statistics.redoneBallCount >= 256);
  const std::vector<double> expected = measureByReference(sheet).values;
  for (size_t i = 0; i < expected.size(); ++i) CHECK(thin.values[i] == doctest::Approx(expected[i]).epsilon(1e-9));
}
