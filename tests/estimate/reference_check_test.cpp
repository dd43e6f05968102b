#include "estimate/reference_check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "bvh/bvh.h"
#include "generate/shapes.h"
#include "pipeline/prepared_mesh.h"
#include "support/shared_session.h"

using namespace asdfvk;

namespace {

constexpr uint64_t kAll = std::numeric_limits<uint64_t>::max();

/// A mesh with all faces traced, so that a test can change values.
struct TracedSphere {
  Mesh mesh = makeSphere(320).mesh;
  PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  Cone cone = makeCone({});
  Seeds traced;
  std::vector<uint8_t> isSeed = std::vector<uint8_t>(mesh.faceCount(), 1);

  TracedSphere() {
    traced.nodes = prepared.traceableFaces;
    traced.values.resize(traced.nodes.size());
    makeReferenceTracer(scene, cone)->trace(traced.nodes, {traced.values}, {});
  }
  [[nodiscard]] CheckReport check(uint64_t count) const {
    return checkAgainstReference(scene, cone, prepared.traceableFaces, {traced, isSeed, traced.values}, count, 1, {});
  }
};

}  // namespace

TEST_CASE("a traced result agrees with the reference and its interpolation error is small") {
  const Mesh mesh = makeTorus(4000).mesh;
  Options options = test::tenthOfFaces();
  options.checkCount = 1000;
  const Result result = test::vulkanSession().compute(mesh, options);
  REQUIRE(result.report.check);
  const CheckReport& check = *result.report.check;
  CHECK(check.independent);
  CHECK(check.passed == true);
  CHECK(check.tracedCount == result.report.seedCount);  // Fewer than 1000: all of them.
  CHECK(check.agreeingCount == check.tracedCount);
  CHECK(check.comparedCount == 1000);
  CHECK(check.interpolatedCount > 800);
  CHECK(check.interpolatedCount < 1000);
  CHECK(check.averageError > 0);
  CHECK(check.averageError < 0.15);
  CHECK(check.maximumError >= check.averageError);
  // Seeds have no error, so leaving them out raises the average.
  CHECK(check.interpolatedAverageError > check.averageError);
  CHECK(check.interpolatedMaximumError == check.maximumError);
}

TEST_CASE("few seeds among many faces are all checked, whatever the requested number") {
  const Mesh mesh = makeTorus(4000).mesh;
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::ofCount(1);
  options.checkCount = 5;
  const CheckReport check = test::vulkanSession().compute(mesh, options).report.check.value();
  CHECK(check.tracedCount == 1);
  CHECK(check.comparedCount == 5);
  CHECK(check.passed == true);
}

TEST_CASE("values that the reference traced are not compared with the reference") {
  const Mesh mesh = makeTorus(2000).mesh;
  Options options = test::tenthOfFaces();
  options.checkCount = 500;
  const CheckReport check = test::referenceSession().compute(mesh, options).report.check.value();
  CHECK_FALSE(check.independent);
  CHECK_FALSE(check.passed.has_value());
  CHECK(check.tracedCount == 0);
  CHECK(check.comparedCount == 500);
  CHECK(check.averageError > 0);
}

TEST_CASE("wrong values are found, with the face of the worst") {
  TracedSphere sphere;
  CHECK(sphere.check(kAll).passed == true);
  CHECK(sphere.check(kAll).tracedCount == 320);

  sphere.traced.values[77] *= 1.01;
  sphere.traced.values[78] *= 1.001;
  const CheckReport wrong = sphere.check(kAll);
  CHECK(wrong.passed == false);
  CHECK(wrong.worstFace == 77);
  CHECK(wrong.agreeingCount == 318);
  CHECK(wrong.missCount() == 2);

  sphere.traced.values[78] = kNoValue;  // One side without a value is a disagreement too.
  CHECK(sphere.check(kAll).passed == false);
  CHECK(sphere.check(kAll).worstFace == 78);
}

TEST_CASE("one miss among few faces passes, the only face must not miss") {
  TracedSphere sphere;
  sphere.traced.values[77] *= 1.01;
  CHECK(sphere.check(kAll).passed == true);
  CHECK(sphere.check(kAll).agreeingCount == 319);

  std::fill(sphere.isSeed.begin(), sphere.isSeed.end(), uint8_t{0});
  sphere.isSeed[77] = 1;
  const CheckReport alone = sphere.check(10);
  CHECK(alone.tracedCount == 1);
  CHECK(alone.passed == false);
}

TEST_CASE("faces without a value on both sides are counted separately") {
  Mesh mesh = makeSphere(320).mesh;
  // A second, flat part, whose rays hit nothing.
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& corner : {Vec3d{50, 0, 0}, Vec3d{51, 0, 0}, Vec3d{50, 1, 0}}) mesh.vertices.push_back(corner);
  mesh.faces.push_back({first, first + 1, first + 2});
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::all();
  options.checkCount = kAll;
  const CheckReport check = test::vulkanSession().compute(mesh, options).report.check.value();
  CHECK(check.tracedCount == 321);
  CHECK(check.noValueAgreeCount == 1);
  CHECK(check.agreeingCount == 320);
  CHECK(check.comparedCount == 320);
  CHECK(check.passed == true);
}

TEST_CASE("without a traced face a check has not passed") {
  TracedSphere sphere;
  std::fill(sphere.isSeed.begin(), sphere.isSeed.end(), uint8_t{0});
  CHECK(sphere.check(kAll).passed == false);
}

TEST_CASE("a check has its own part of the progress and ends it") {
  const Mesh mesh = makeTorus(4000).mesh;
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::all();
  options.checkCount = kAll;
  std::vector<double> fractions;
  const RunControl control{{}, [&](double fraction) { fractions.push_back(fraction); }};
  (void)test::referenceSession().compute(mesh, options, control);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.back() == 1);
  CHECK(std::count(fractions.begin(), fractions.end(), 1.0) == 1);
  CHECK(std::count_if(fractions.begin(), fractions.end(), [](double x) { return x >= 0.6 && x < 1; }) > 2);
}
