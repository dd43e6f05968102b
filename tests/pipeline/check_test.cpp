#include "pipeline/check.h"

#include <doctest/doctest.h>

#include "generate/shapes.h"
#include "support/shared_session.h"
#include "trace/reference_tracer.h"

using namespace asdfvk;

TEST_CASE("a traced result agrees with the reference and its interpolation error is small") {
  Mesh mesh = makeTorus(4000).mesh;
  Options options;
  options.checkCount = 1000;
  const Result result = test::vulkanSession().compute(mesh, options);
  REQUIRE(result.report.check);
  const CheckReport& check = *result.report.check;
  CHECK(check.passed);
  CHECK(check.tracedCount + check.interpolatedCount == 1000);
  CHECK(check.tracedCount > 50);
  CHECK(check.agreeingCount == check.tracedCount);
  CHECK(check.averageError > 0);
  CHECK(check.averageError < 0.1);
  CHECK(check.maximumError >= check.averageError);
}

TEST_CASE("a wrong value is found, with its face") {
  Mesh mesh = makeSphere(320).mesh;
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  const Cone cone = makeCone({});
  Options options;
  options.seeds.kind = SeedCount::Kind::All;
  TracedSeeds traced = traceSeeds(prepared, *makeReferenceTracer(scene, cone), options, {});
  CHECK(checkAgainstReference(mesh, prepared, scene, cone, traced, traced.values, 320, 1, {}).passed);

  traced.values[77] *= 1.01;
  const CheckReport wrong = checkAgainstReference(mesh, prepared, scene, cone, traced, traced.values, 320, 1, {});
  CHECK_FALSE(wrong.passed);
  CHECK(wrong.worstFace == 77);
  CHECK(wrong.agreeingCount == 319);

  traced.values[77] = kNoValue;  // one side without a value is a disagreement too
  CHECK_FALSE(checkAgainstReference(mesh, prepared, scene, cone, traced, traced.values, 320, 1, {}).passed);
}
