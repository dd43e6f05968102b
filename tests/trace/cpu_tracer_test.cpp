#include "trace/cone_tracer.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "generate/shapes.h"
#include "hit_checks.h"
#include "hit_comparison.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

TraceResults traceByCpu(const TracedMesh& traced, const ConeOptions& options = {}, Wanted wanted = Wanted::Values,
                        const RunControl& control = {}) {
  const Cone cone = makeCone(options);
  return traceAll(*makeCpuTracer(traced.scene(), cone), traced, options.rayCount, wanted, control);
}

void checkParity(const TracedMesh& traced, const ConeOptions& options = {}) {
  const TraceResults reference = traceByReference(traced, options, Wanted::ValuesAndHits);
  const TraceResults results = traceByCpu(traced, options, Wanted::ValuesAndHits);
  const double diagonal = traced.geometry.bounds.diagonal();
  REQUIRE(!reference.values.empty());
  CHECK(differingCount(results.values, reference.values, diagonal) <= reference.values.size() / 1000);
  CHECK(differingRays(results.hits, reference.hits) <= reference.hits.size() / 1000);
  CHECK(missCount(results.hits) == missCount(reference.hits));
  CHECK(results.statistics.redoneConeCount <= reference.values.size() / 100);
  CHECK(results.statistics.rayCount == reference.hits.size());
  CHECK(test::haveSameBits(traceByCpu(traced, options).values, results.values));  // With and without requested hits.
}

/// Two layers of the same square, cut along the other diagonals, with opposite orientations: every ray from one hits
/// faces of both at exactly the same distance.
Mesh twoLayersOfAWall(uint32_t side) {
  Mesh mesh;
  const double step = 2.0 / side;
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x) mesh.vertices.push_back({x * step - 1, y * step - 1, 0});
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
      mesh.faces.insert(mesh.faces.end(), {{a, b, d}, {a, d, c}, {a, c, b}, {b, c, d}});
    }
  return mesh;
}

}  // namespace

TEST_CASE("the CPU tracer gives the reference's values and hits on every generated shape" *
          doctest::test_suite("slow")) {
  for (const std::string_view name : shapeNames()) {
    CAPTURE(name);
    checkParity(TracedMesh(shapes::jittered(generateShape(name, 3000).mesh, 1e-4, 9)));
  }
}

TEST_CASE("the CPU tracer gives the reference's values and hits on open, crossing, nested and non-manifold meshes") {
  checkParity(TracedMesh(shapes::jittered(shapes::openBox({1, 2, 3}, 8), 0.01, 2)));
  checkParity(TracedMesh(shapes::soup(2000, 5)));
  checkParity(TracedMesh(shapes::shell(2, 1)));
  checkParity(TracedMesh(shapes::jittered(shapes::boxesWithSharedEdge(), 1e-3, 1)));
  checkParity(TracedMesh(shapes::inverted(shapes::icosphere(3))));
}

TEST_CASE("the CPU tracer obeys every option of the cone") {
  const TracedMesh traced(generateShape("animal", 1500).mesh), small(generateShape("animal", 300).mesh);
  for (const uint32_t rayCount : {1u, 2u, 7u, 8u, 9u, 33u}) checkParity(traced, {.rayCount = rayCount});
  for (const uint32_t rayCount : {257u, 1024u}) checkParity(small, {.rayCount = rayCount});
  checkParity(traced, {.falseHitAngleDegrees = 20});
  checkParity(traced, {.openingAngleDegrees = 60, .falseHitAngleDegrees = 150});
  checkParity(traced, {.outlierDeviations = 0.5});
  checkParity(traced, {.rotation = ConeRotation::Hashed});
}

TEST_CASE("the CPU tracer gives the reference's values by CGAL's definition") {
  for (const std::string_view name : shapeNames()) {
    CAPTURE(name);
    checkParity(TracedMesh(shapes::jittered(generateShape(name, 2000).mesh, 1e-4, 9)),
                {.rayCount = 25, .definition = Definition::Cgal});
  }
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  for (const uint32_t rayCount : {1u, 2u, 7u, 8u, 33u, 257u})
    checkParity(traced, {.rayCount = rayCount, .definition = Definition::Cgal});
}

TEST_CASE("cones of nearly 180 degrees do not end at their own face" * doctest::test_suite("slow")) {
  const ConeOptions wide{.rayCount = 1024, .openingAngleDegrees = 179.9999};
  const TracedMesh traced(shapes::icosphere(3));
  const TraceResults results = traceByCpu(traced, wide, Wanted::ValuesAndHits);
  size_t ownFaceCount = 0;
  for (size_t i = 0; i < results.hits.size(); ++i) ownFaceCount += results.hits[i].face == i / wide.rayCount;
  CHECK(ownFaceCount == 0);
  CHECK(differingCount(results.values, traceByReference(traced, wide, Wanted::Values).values, 2) == 0);
}

TEST_CASE("where float32 suffices, lengths equal those of the reference to the resolution of double") {
  const TracedMesh traced(shapes::jittered(shapes::icosphere(3), 0.03, 7));
  const TraceResults results = traceByCpu(traced);
  const std::vector<double> reference = traceByReference(traced, {}, Wanted::Values).values;
  CHECK(results.statistics.redoneConeCount == 0);
  size_t differing = 0;
  for (size_t i = 0; i < reference.size(); ++i) differing += !(std::abs(results.values[i] - reference[i]) <= 1e-13);
  CHECK(differing == 0);
}

TEST_CASE("details too small for float32 are the reference's to the bit, and counted") {
  const Mesh large = generateShape("sphere", 500).mesh;
  const Mesh tiny = shapes::scaledAndShifted(large, 1e-6, {0.9, 0.9, 0.9});
  const TracedMesh traced(shapes::joined(large, tiny));
  const std::vector<double> reference = traceByReference(traced, {}, Wanted::Values).values;
  const TraceResults results = traceByCpu(traced);
  CHECK(results.statistics.redoneConeCount == tiny.faces.size());
  for (size_t i = large.faces.size(); i < reference.size(); ++i) CHECK(results.values[i] == reference[i]);

  Mesh flat = generateShape("slab", 500).mesh;  // its faces are large, its thickness is not
  for (Vec3d& v : flat.vertices) v.z *= 1e-5;
  const TracedMesh flattened(flat);
  const TraceResults thin = traceByCpu(flattened);
  CHECK(thin.statistics.redoneConeCount > thin.values.size() / 2);
  CHECK(differingCount(thin.values, traceByReference(flattened, {}, Wanted::Values).values, 1e-9) == 0);
}

TEST_CASE("no ray leaks along the sides of boxes, nor through vertices and edges") {
  for (const uint32_t side : {1u, 3u, 10u}) {
    const TracedMesh traced(shapes::box({2, 3, 0.01}, side));
    const TraceResults results = traceByCpu(traced, {}, Wanted::ValuesAndHits);
    CHECK(missCount(results.hits) == 0);
    CHECK(differingCount(results.values, traceByReference(traced, {}, Wanted::Values).values, 4) == 0);
  }
}

TEST_CASE("no ray passes between the triangles of a closed surface with vertices in float32") {
  Mesh mesh = generateShape("cylinder", 20'000).mesh;
  for (Vec3d& vertex : mesh.vertices) vertex = Vec3d(Vec3f(vertex));
  const TracedMesh traced(mesh);
  const TraceResults results = traceByCpu(traced, {}, Wanted::ValuesAndHits);
  CHECK(missCount(results.hits) == 0);
  CHECK(results.statistics.redoneConeCount == 0);
  CHECK(differingCount(results.values, traceByReference(traced, {}, Wanted::Values).values, 1e-6) <= 1);
}

TEST_CASE("open surfaces and such as cross are not traced again by the reference, though rays leave them") {
  for (const Mesh& mesh : {shapes::jittered(shapes::openBox({1, 2, 3}, 8), 0.01, 2), shapes::soup(2000, 5),
                           shapes::inverted(shapes::icosphere(3))}) {
    const TraceResults results = traceByCpu(TracedMesh(mesh), {}, Wanted::ValuesAndHits);
    CHECK(missCount(results.hits) > 0);
    CHECK(results.statistics.redoneConeCount == 0);
  }
}

TEST_CASE("copies of faces, and degenerate ones beside them, change no value of the CPU tracer") {
  Mesh mesh = generateShape("torus", 600).mesh;
  const std::vector<double> expected = traceByCpu(TracedMesh(mesh)).values;
  const size_t count = mesh.faces.size();
  for (size_t f = 0; f < count; f += 7) mesh.faces.push_back(mesh.faces[f]);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.vertices.push_back({nan, 0, 0});
  mesh.faces.insert(mesh.faces.end(), {{0, 0, 1}, {0, 1, static_cast<uint32_t>(mesh.vertices.size() - 1)}});
  const TraceResults results = traceByCpu(TracedMesh(mesh), {}, Wanted::ValuesAndHits);
  for (size_t f = 0; f < count; ++f) CHECK(results.values[f] == doctest::Approx(expected[f]).epsilon(1e-6));
  REQUIRE(results.values.size() == count + (count + 6) / 7);
  for (size_t i = 0; count + i < results.values.size(); ++i)
    CHECK(results.values[count + i] == doctest::Approx(expected[7 * i]).epsilon(1e-6));
  for (const ConeHit& hit : results.hits) REQUIRE(hit.face < count);
}

TEST_CASE("values of the CPU tracer have the same bits with one thread and with two, among equally near faces too") {
  for (const Mesh& mesh :
       {generateShape("hand", 8000).mesh,
        shapes::joined(twoLayersOfAWall(60), shapes::scaledAndShifted(twoLayersOfAWall(60), 1, {0, 0, 0.5}))}) {
    const TracedMesh traced(mesh);
    TraceResults results[2];
    for (const size_t threadCount : {1, 2}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threadCount);
      results[threadCount - 1] = traceByCpu(traced, {}, Wanted::ValuesAndHits);
    }
    CHECK(test::haveSameBits(results[0].values, results[1].values));
    CHECK(test::haveSameBits(results[0].hits, results[1].hits));
  }
}

TEST_CASE("values of the CPU tracer do not depend on number and order of the seeds, nor on earlier traces") {
  const TracedMesh traced(generateShape("hand", 4000).mesh);
  const Cone cone = makeCone({});
  std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> forward(seeds.size()), backward(seeds.size());
  const auto tracer = makeCpuTracer(traced.scene(), cone);
  tracer->trace(seeds, {forward}, {});
  for (const size_t count : {1u, 31u, 32u, 33u}) {
    std::vector<double> few(count);
    tracer->trace(std::span(seeds).first(count), {few}, {});
    CHECK(test::haveSameBits(few, {forward.begin(), forward.begin() + static_cast<ptrdiff_t>(count)}));
  }
  std::reverse(seeds.begin(), seeds.end());
  tracer->trace(seeds, {backward}, {});
  std::reverse(backward.begin(), backward.end());
  CHECK(test::haveSameBits(forward, backward));
}

TEST_CASE("meshes without a face, or with one, have no value") {
  CHECK(traceByCpu(TracedMesh(Mesh{})).values.empty());
  const TracedMesh alone(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}});
  const TraceResults none = traceByCpu(alone, {}, Wanted::ValuesAndHits);
  CHECK(std::isnan(none.values.front()));
  CHECK(missCount(none.hits) == none.hits.size());
}

TEST_CASE("a trace on the CPU reports its progress and stops between chunks on request") {
  const TracedMesh traced(generateShape("torus", 10'000).mesh);
  std::vector<double> fractions;
  std::stop_source stop;
  RunControl control{stop.get_token(), [&](double fraction) { fractions.push_back(fraction); }};
  (void)traceByCpu(traced, {}, Wanted::Values, control);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.size() > 2);
  CHECK(fractions.front() == 0);
  CHECK(fractions.back() == 1);
  control.progress = [&](double fraction) {
    if (fraction > 0) stop.request_stop();
  };
  try {
    (void)traceByCpu(traced, {}, Wanted::Values, control);
    FAIL("it ran to the end");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
}

TEST_CASE("results without room for the cones, and degenerate seeds, are refused by the CPU tracer too") {
  Mesh mesh = shapes::icosphere(0);
  mesh.faces.push_back({0, 0, 1});
  const TracedMesh traced(mesh);
  const Cone cone = makeCone({});
  const auto tracer = makeCpuTracer(traced.scene(), cone);
  std::vector<double> values(2);
  CHECK_THROWS_AS(tracer->trace(std::vector<uint32_t>{0}, {values}, {}), CheckFailure);
  CHECK_THROWS_AS(tracer->trace(std::vector<uint32_t>{0, 20}, {values}, {}), CheckFailure);
}
