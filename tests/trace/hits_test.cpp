#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "brute_force.h"
#include "core/check.h"
#include "generate/shapes.h"
#include "hit_checks.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

struct HitCounts {
  size_t rays = 0, misses = 0, falseHits = 0;
  size_t wrongFaces = 0, wrongDistances = 0;
};

HitCounts compareWithBruteForce(const Mesh& mesh, const ConeOptions& options = {}) {
  const TracedMesh traced(mesh);
  const Cone cone = makeCone(options);
  const double scale = traced.bvh.normalization.scale;
  const TraceResults results = traceByReference(traced, options, Wanted::ValuesAndHits);
  const std::vector<uint32_t> seeds = traced.seedFaces();
  HitCounts counts;
  for (size_t i = 0; i < seeds.size(); ++i) {
    const BruteForceCone expected = traceByBruteForce(mesh, cone, seeds[i]);
    for (size_t ray = 0; ray < options.rayCount; ++ray) {
      const ConeHit& hit = results.hits[i * options.rayCount + ray];
      const double distance = expected.hitDistances[ray] * scale;
      const bool isMiss = expected.hitFaces[ray] == kNoFace;
      ++counts.rays;
      counts.misses += isMiss;
      counts.falseHits += !isMiss && std::isnan(expected.rayLengths[ray]);
      counts.wrongFaces += hit.face != expected.hitFaces[ray];
      counts.wrongDistances +=
          isMiss ? hit.distance != float(INFINITY) : !(std::abs(hit.distance - distance) <= 1e-7 * distance + 1e-10);
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("the reference's hits are the nearest faces by brute force, false ones and misses too") {
  const HitCounts dented = compareWithBruteForce(shapes::jittered(shapes::icosphere(2), 0.05, 1));
  const HitCounts soup = compareWithBruteForce(shapes::soup(300, 3));
  const HitCounts open = compareWithBruteForce(shapes::jittered(shapes::openBox({1, 1, 1}, 6), 0.02, 2));
  const HitCounts turned = compareWithBruteForce(shapes::jittered(shapes::icosphere(2), 0.05, 4),
                                                 {.rayCount = 12, .rotation = ConeRotation::Hashed});
  const HitCounts cgal = compareWithBruteForce(shapes::soup(300, 5), {.rayCount = 25, .definition = Definition::Cgal});
  for (const HitCounts& counts : {dented, soup, open, turned, cgal}) {
    CHECK(counts.rays > 1000);
    CHECK(counts.wrongFaces == 0);
    CHECK(counts.wrongDistances == 0);
  }
  CHECK(soup.falseHits > 100);
  CHECK(cgal.falseHits > 100);
  CHECK(soup.misses > 100);
  CHECK(open.misses > 100);
  CHECK(dented.misses == 0);
}

TEST_CASE("asking the reference for hits changes no bit of the values") {
  const TracedMesh traced(generateShape("animal", 1500).mesh);
  const TraceResults values = traceByReference(traced, {}, Wanted::Values);
  CHECK(test::haveSameBits(traceByReference(traced, {}, Wanted::ValuesAndHits).values, values.values));
}

TEST_CASE("the reference's hits give its values") {
  for (const ConeOptions& options : {ConeOptions{}, ConeOptions{.rayCount = 7, .rotation = ConeRotation::Hashed},
                                     ConeOptions{.falseHitAngleDegrees = 30, .outlierDeviations = 2},
                                     ConeOptions{.rayCount = 25, .definition = Definition::Cgal}}) {
    const TracedMesh traced(generateShape("animal", 1500).mesh);
    const TraceResults results = traceByReference(traced, options, Wanted::ValuesAndHits);
    const std::vector<double> values = valuesOfHits(traced, options, results.hits);
    REQUIRE(values.size() == results.values.size());
    size_t differing = 0;  // by more than float32 rounds: a length on the bound of the outliers
    for (size_t i = 0; i < values.size(); ++i)
      differing += !(std::abs(values[i] - results.values[i]) <= 1e-6 * results.values[i]) &&
                   !(std::isnan(values[i]) && std::isnan(results.values[i]));
    CHECK(differing <= values.size() / 1000);
  }
}

TEST_CASE("a hit names the face that stands for its copies, and a cone passes through those of its seed") {
  Mesh mesh = shapes::jittered(shapes::icosphere(1), 0.05, 3);
  const uint32_t count = mesh.faceCount();
  mesh.faces.insert(mesh.faces.end(), mesh.faces.begin(), mesh.faces.begin() + count);
  const TracedMesh traced(mesh);
  const ConeOptions options;
  const TraceResults results = traceByReference(traced, options, Wanted::ValuesAndHits);
  for (size_t i = 0; i < results.hits.size(); ++i) {
    REQUIRE(results.hits[i].face < count);
    REQUIRE(results.hits[i].face != i / options.rayCount % count);
    REQUIRE(results.hits[i].face == results.hits[i % (count * options.rayCount)].face);
  }
}

TEST_CASE("results without room for the cones are refused") {
  const TracedMesh traced(shapes::icosphere(0));
  const Cone cone = makeCone({});
  const std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> values(seeds.size());
  std::vector<ConeHit> hits(seeds.size() * 30 - 1);
  const auto tracer = makeReferenceTracer(traced.scene(), cone);
  CHECK_THROWS_AS(tracer->trace(seeds, {values, hits}, {}), CheckFailure);
  CHECK_THROWS_AS(tracer->trace(seeds, {std::span(values).first(3)}, {}), CheckFailure);
}
