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

constexpr uint64_t kFineFaceCount = 100'000, kFineFaceCountIfPooled = 300'000;

Session& cpuSession() { return *test::allSessions().back(); }

Options seedsOf(double share) {
  Options options;
  options.seeds = SeedCount::ofShare(share);
  return options;
}

/// Whether aggregatesFor() finds aggregates that are useful.
bool hasAggregates(const Mesh& mesh, double share, bool isPooled = false) {
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const auto seedCount = static_cast<uint64_t>(share * static_cast<double>(mesh.faces.size()));
  return aggregatesFor(prepared, seedCount, isPooled) != nullptr;
}

bool isCentre(const AggregatedMesh& aggregated, uint32_t face) {
  const FaceDomain domain = aggregated.domain();
  return std::binary_search(domain.faces.begin(), domain.faces.end(), face);
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
  REQUIRE(fine.faces.size() > 90'000);
  CHECK(hasAggregates(fine, 0.1));
  CHECK(hasAggregates(fine, 0.01));
  CHECK_FALSE(hasAggregates(fine, 0.2));  // Too many seeds.
  CHECK(hasAggregates(shapes::grid(200), 0.01));
  CHECK_FALSE(hasAggregates(shapes::grid(180), 0.01));  // 64,800 faces.
  CHECK_FALSE(hasAggregates(fine, 0.01, true));
  CHECK(hasAggregates(makeAnimal(kFineFaceCountIfPooled).mesh, 0.01, true));
  Mesh animals;  // Coarse, although the mesh has many faces.
  for (int i = 0; i < 10; ++i) animals = shapes::joined(std::move(animals), makeAnimal(10'000).mesh, {3.0 * i, 0, 0});
  REQUIRE(animals.faces.size() > 90'000);
  CHECK_FALSE(hasAggregates(animals, 0.01));
  Mesh spheres;  // Components of 80 faces, whose faces are their own aggregates.
  for (int i = 0; i < 1200; ++i) spheres = shapes::joined(std::move(spheres), makeSphere(80, 1).mesh, {3.0 * i, 0, 0});
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
  const Mesh mesh = makeAnimal(kFineFaceCountIfPooled).mesh;
  Options options = seedsOf(0.02);
  options.interpolation.pooling = 0.75;
  options.estimatesError = false;  // Held-out faces are chosen by predictions, whose last bits differ on a device.
  const Result onCpu = cpuSession().compute(mesh, options);
  options.solver = SolverChoice::Cg;
  const Result onDevice = test::vulkanSession().compute(mesh, options);
  CHECK(onDevice.report.solver.name == "cg");
  CHECK(onDevice.seed() == onCpu.seed());
  CHECK(averageError(onDevice.sdf(), onCpu.sdf()) < 1e-5);
  options.estimatesError = true;
  const Result withEstimate = test::vulkanSession().compute(mesh, options);
  options.solver = SolverChoice::Cpu;
  const double bound = withEstimate.report.runsOnCpu ? 2e-4 : 1e-3;
  CHECK(averageError(withEstimate.sdf(), cpuSession().compute(mesh, options).sdf()) < bound);
}

TEST_CASE("the domain of aggregates has their centres as nodes, and its values are spread over all faces") {
  const Mesh mesh = makeAnimal(kFineFaceCount).mesh;
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const AggregatedMesh aggregated(prepared);
  const FaceDomain domain = aggregated.domain();
  REQUIRE(2 * domain.size() < mesh.faces.size());
  CHECK(std::is_sorted(domain.faces.begin(), domain.faces.end()));
  uint64_t faceCount = 0;
  for (uint32_t node = 0; node < domain.size(); ++node) {
    faceCount += domain.representedCountOf(node);
    REQUIRE(domain.geometry.normals[node] == prepared.geometry.normals[domain.faceOf(node)]);
    REQUIRE(domain.componentOf[node] == prepared.components.componentOf[domain.faceOf(node)]);
  }
  CHECK(faceCount == mesh.faces.size());
  std::vector<double> values(domain.size());
  UnsetVector<double> entries(domain.size());
  for (uint32_t node = 0; node < domain.size(); ++node) values[node] = entries[node] = 1 + node % 5;
  const std::vector<double> spread = aggregated.spreadValues(values);
  const UnsetVector<double> spreadEntries = aggregated.spreadEntries(entries);
  REQUIRE(spread.size() == mesh.faces.size());
  REQUIRE(spreadEntries.size() == mesh.faces.size());
  for (uint32_t node = 0; node < domain.size(); ++node) {
    REQUIRE(spread[domain.faceOf(node)] == values[node]);
    REQUIRE(spreadEntries[domain.faceOf(node)] == values[node]);
  }
  CHECK(std::all_of(spread.begin(), spread.end(), [](double value) { return value >= 1 && value <= 5; }));
}

TEST_CASE("only centres are seeds, with pooling all faces of a mesh of this size") {
  const Mesh mesh = makeAnimal(kFineFaceCount).mesh;
  Options options = seedsOf(0.02);
  options.estimatesError = false;
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const auto aggregated = aggregatesFor(prepared, mesh.faces.size() / 50, false);
  REQUIRE(aggregated);
  const auto countOtherSeeds = [&] {
    const Result result = cpuSession().compute(mesh, options);
    size_t count = 0;
    for (uint32_t face = 0; face < mesh.faces.size(); ++face)
      count += result.seed()[face] != 0 && !isCentre(*aggregated, face) ? 1 : 0;
    return count;
  };
  CHECK(countOtherSeeds() == 0);
  options.interpolation.pooling = 0.75;
  CHECK(countOtherSeeds() > 100);
}

TEST_CASE("a component whose centres have no valid ray has the value of another face") {
  Mesh mesh = shapes::grid(200);
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const auto aggregated = aggregatesFor(prepared, 1000, false);
  REQUIRE(aggregated);
  auto face = static_cast<uint32_t>(mesh.faces.size() / 2);
  while (isCentre(*aggregated, face)) ++face;
  // Below the sheet, a triangle that only the rays of this face hit.
  const Vec3d place = prepared.geometry.barycentres[face] - Vec3d{0, 0, 0.05};
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& offset : {Vec3d{-0.04, -0.04, 0}, Vec3d{0.08, 0, 0}, Vec3d{0, 0.08, 0}})
    mesh.vertices.push_back(place + offset);
  mesh.faces.push_back({first, first + 2, first + 1});
  const Result result = cpuSession().compute(mesh, seedsOf(0.01));
  CHECK(result.seed()[face] == 1);
  CHECK(result.sdf()[face] == doctest::Approx(0.05).epsilon(0.05));
  CHECK(result.report.noValueCount <= 1);
}
