#include "pipeline/aggregated_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/scene.h"
#include "generate/shapes.h"
#include "pipeline/average_error.h"
#include "support/shapes.h"

using namespace asdfvk;
using test::averageError;

namespace {

constexpr uint64_t kFineFaceCount = 160'000;

Session& cpuSession() { return *test::allSessions().back(); }

Options seedsOf(double share) {
  Options options;
  options.seeds = SeedCount::ofShare(share);
  return options;
}

/// Whether aggregatesFor() finds aggregates that are useful.
bool hasAggregates(const Mesh& mesh, double share) {
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const auto seedCount = static_cast<uint64_t>(share * static_cast<double>(mesh.faces.size()));
  return aggregatesFor(prepared, seedCount) != nullptr;
}

/// The result without aggregates: a region of all faces but one has none.
Result withoutAggregates(Scene& scene, size_t faceCount, const Options& options) {
  std::vector<uint8_t> region(faceCount, 1);
  region.back() = 0;
  return scene.compute(options, region);
}

}  // namespace

TEST_CASE("fine meshes have aggregates, others do not") {
  const Mesh fine = makeAnimal(kFineFaceCount).mesh;
  REQUIRE(fine.faces.size() > 140'000);
  CHECK(hasAggregates(fine, 0.1));
  CHECK(hasAggregates(fine, 0.01));
  CHECK_FALSE(hasAggregates(fine, 0.2));  // Too many seeds.
  CHECK_FALSE(hasAggregates(makeAnimal(60'000).mesh, 0.01));
  Mesh spheres;  // Components of 80 faces, whose faces are their own aggregates.
  for (int i = 0; i < 1700; ++i) spheres = shapes::joined(std::move(spheres), makeSphere(80, 1).mesh, {3.0 * i, 0, 0});
  CHECK_FALSE(hasAggregates(spheres, 0.01));
}

TEST_CASE("values by aggregates are nearly as good as without, and their errors are estimated" *
          doctest::test_suite("slow")) {
  const Mesh mesh = makeAnimal(kFineFaceCount).mesh;
  Scene scene(cpuSession(), mesh);
  Options all;
  all.seeds = SeedCount::all();
  const std::vector<double> truth = scene.compute(all).sdf();
  for (const double share : {0.1, 0.02}) {
    CAPTURE(share);
    const Options options = seedsOf(share);
    const Result aggregated = scene.compute(options);
    const auto seedCount = static_cast<uint64_t>(std::round(share * static_cast<double>(mesh.faces.size())));
    CHECK(aggregated.report.seedCount == seedCount);
    CHECK(static_cast<uint64_t>(std::count(aggregated.seed().begin(), aggregated.seed().end(), 1)) == seedCount);
    for (size_t face = 0; face < truth.size(); ++face)
      if (aggregated.seed()[face]) CHECK(aggregated.sdf()[face] == truth[face]);
    std::vector<double> plain = withoutAggregates(scene, mesh.faces.size(), options).sdf();
    plain.back() = truth.back();
    const double error = averageError(aggregated.sdf(), truth), plainError = averageError(plain, truth);
    CHECK(error != plainError);
    CHECK(error < 1.1 * plainError);
    REQUIRE(aggregated.report.estimatedError);
    // The estimate is over the range of the traced values, which may lack the extremes of the function.
    CHECK(aggregated.report.estimatedError->relativeMedian ==
          doctest::Approx(test::relativeErrorAt(0.5, aggregated.sdf(), truth)).epsilon(0.25));
    const std::vector<double>& expected = *requireField(aggregated.fields, "error").reals();
    for (size_t face = 0; face < truth.size(); ++face) CHECK((expected[face] == 0) == (aggregated.seed()[face] != 0));
  }
}

TEST_CASE("the values of a fine mesh do not depend on the solver, and pooling uses predictions of aggregates" *
          doctest::test_suite("slow")) {
  const Mesh mesh = makeAnimal(kFineFaceCount).mesh;
  Options options = seedsOf(0.02);
  options.interpolation.pooling = 0.75;
  const Result onCpu = cpuSession().compute(mesh, options);
  options.solver = "cg";
  const Result onDevice = test::vulkanSession().compute(mesh, options);
  CHECK(onDevice.report.solver.name == "cg");
  CHECK(averageError(onDevice.sdf(), onCpu.sdf()) < 2e-4);
}
