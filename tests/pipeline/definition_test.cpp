#include <doctest/doctest.h>

#include <cmath>

#include "asdf_vk/error.h"
#include "average_error.h"
#include "generate/shapes.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::averageError;
using test::referenceSession;
using test::vulkanSession;

namespace {

Options cgalOptions() {
  Options options;
  applyDefinition(Definition::Cgal, options);
  return options;
}

Options cgalOptions(double share) {
  Options options = cgalOptions();
  options.seeds = SeedCount::ofShare(share);
  return options;
}

/// A sheet above one half of another one: half of the lower faces have an opposite side. The last face is degenerate.
Mesh halfCoveredSheet() {
  Mesh mesh;
  const auto add = [&](double width, double z, bool isUp) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (const double y : {0.0, 0.02})
      for (int x = 0; x <= 20; ++x) mesh.vertices.push_back({width * x / 20, y, z});
    for (uint32_t x = first; x < first + 20; ++x) {
      const Face lower{x, x + 1, x + 22}, upper{x, x + 22, x + 21};
      for (const auto& [a, b, c] : {lower, upper}) mesh.faces.push_back(isUp ? Face{a, b, c} : Face{a, c, b});
    }
  };
  add(1, 0, false);
  add(0.5, 0.001, true);
  mesh.faces.push_back({0, 0, 1});
  return mesh;
}

}  // namespace

TEST_CASE("CGAL's definition casts 25 rays from every face, and the paper's 30 from an automatic number") {
  Options options = cgalOptions();
  CHECK(options.cone.rayCount == 25);
  CHECK(options.seeds.kind == SeedCount::Kind::All);
  const Mesh mesh = makeTorus(1000).mesh;
  const Result result = referenceSession().compute(mesh, options);
  CHECK(result.report.rayCount == 25 * mesh.faces.size());
  applyDefinition(Definition::Paper, options);
  CHECK(options.cone.definition == Definition::Paper);
  CHECK(options.cone.rayCount == 30);
  CHECK(options.seeds.kind == SeedCount::Kind::Automatic);
}

TEST_CASE("faces whose rays all miss, and degenerate ones, have no value by CGAL's definition") {
  const Mesh mesh = halfCoveredSheet();
  const Result all = referenceSession().compute(mesh, cgalOptions());
  const std::vector<double> values = all.sdf();
  size_t missing = 0;
  for (const double value : values) missing += std::isnan(value);
  CHECK(missing > 15);
  CHECK(missing < 30);
  CHECK(std::isnan(values.back()));
  CHECK(all.report.solver.name == "none");
  const Result some = referenceSession().compute(mesh, cgalOptions(0.5));
  const auto& seeds = some.seed();
  for (size_t face = 0; face < values.size(); ++face)
    if (seeds[face] != 0) CHECK(std::isnan(some.sdf()[face]) == std::isnan(values[face]));
  CHECK(std::isnan(some.sdf().back()));
  Options paper;
  paper.seeds = SeedCount::all();
  CHECK(referenceSession().compute(mesh, paper).report.noValueCount == 0);
}

TEST_CASE("a tenth of the faces with CGAL's definition: prediction helps and the error is estimated" *
          doctest::test_suite("slow")) {
  for (const Mesh& mesh : {makeAnimal(8000).mesh, makeHand(8000).mesh}) {
    const std::vector<double> truth = referenceSession().compute(mesh, cgalOptions()).sdf();
    Options options = cgalOptions(0.1);
    const Result predicted = referenceSession().compute(mesh, options);
    options.interpolation.guidance = Guidance::None;
    const Result harmonic = referenceSession().compute(mesh, options);
    const double error = averageError(predicted.sdf(), truth);
    MESSAGE("average error ", error, ", without prediction ", averageError(harmonic.sdf(), truth), ", estimate ",
            predicted.report.estimatedError.value().average);
    CHECK(error < 0.95 * averageError(harmonic.sdf(), truth));
    const double ratio = predicted.report.estimatedError.value().average / error;
    CHECK(ratio > 0.6);
    CHECK(ratio < 1.6);
  }
}

TEST_CASE("options of the paper's definition are refused with CGAL's") {
  const Mesh mesh = makeSphere(200).mesh;
  Options options = cgalOptions();
  applyRecipe(Recipe::Quality, options);
  try {
    (void)referenceSession().compute(mesh, options);
    FAIL("it was accepted");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::OptionConflict);
  }
}

TEST_CASE("a session computes by both definitions in turn") {
  const Mesh mesh = makeAnimal(1500).mesh;
  const std::vector<double> paper = vulkanSession().compute(mesh, test::tenthOfFaces()).sdf();
  Options options = cgalOptions();
  options.cone.rayCount = 30;  // The same number of rays: the kernels differ by the definition only.
  options.checkCount = 500;
  const Result cgal = vulkanSession().compute(mesh, options);
  CHECK(cgal.report.check.value().missCount() <= 1);
  CHECK(vulkanSession().compute(mesh, test::tenthOfFaces()).sdf() == paper);
}
