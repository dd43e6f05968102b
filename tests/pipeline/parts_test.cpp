#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stop_token>

#include "generate/shapes.h"
#include "pipeline/segments.h"
#include "segment/rand_index.h"
#include "support/quad_cubes.h"
#include "support/require_failure.h"
#include "support/shared_session.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;
using test::findWarning;
using test::referenceSession;
using test::requireFailure;

namespace {

using Labels = std::vector<uint32_t>;

Options withParts(double seedShare = 1) {
  Options options;
  options.seeds = seedShare < 1 ? SeedCount::ofShare(seedShare) : SeedCount::all();
  options.cone.rayCount = 10;
  options.estimatesError = false;
  options.segmentation = Segmentation::Parts;
  return options;
}

Session& fastSession() {
  static Session session({.backend = BackendChoice::Cpu});
  return session;
}

void checkReport(const Result& result) {
  const Labels& labels = test::segmentsOf(result);
  REQUIRE(result.report.segmentCount.has_value());
  const Report& report = result.report;
  REQUIRE(report.parts.has_value());
  CHECK(*std::max_element(labels.begin(), labels.end()) + 1 == report.segmentCount);
  CHECK(report.parts->areaShares.size() == report.segmentCount);
  const std::vector<double>& shares = report.parts->areaShares;
  CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == doctest::Approx(1));
  CHECK(report.parts->agreement.value_or(0) > 0);
  CHECK(report.parts->agreement.value_or(2) <= 1);
}

/// A thin wall between two spheres.
Mesh bowl() {
  Mesh mesh = makeSphere(1280).mesh;
  const Mesh sphere = mesh;
  const auto offset = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& v : sphere.vertices) mesh.vertices.push_back(v * 0.9);
  for (const auto& [a, b, c] : sphere.faces) mesh.faces.push_back({a + offset, c + offset, b + offset});
  return mesh;
}

}  // namespace

TEST_CASE("parts are a field, a report and a stage, and no normalised values") {
  const GeneratedShape animal = generateShape("animal", 3000);
  const Result result = fastSession().compute(animal.mesh, withParts());
  checkReport(result);
  CHECK(1 - randIndex(test::segmentsOf(result), animal.part) < 0.1);
  CHECK(result.field("normalized") == nullptr);
  CHECK_FALSE(result.report.postprocess.has_value());
  CHECK(result.report.stageSeconds[Stage::Segment] > 0);
  CHECK(result.report.stageSeconds[Stage::Postprocess] == 0);
  CHECK(findWarning(result.report, WarningCode::ThinShell) == nullptr);
  CHECK(findWarning(result.report, WarningCode::PartCountDiffers) == nullptr);
  const Report& report = result.report;
  CHECK(report.parts->fewestCount <= report.segmentCount);
  CHECK(report.parts->mostCount >= report.segmentCount);
}

TEST_CASE("parts from few seeds, and beside normalised values") {
  const GeneratedShape hand = generateShape("hand", 3000);
  Options options = withParts(0.1);
  options.postprocess = Postprocess::Cgal;
  const Result result = fastSession().compute(hand.mesh, options);
  checkReport(result);
  CHECK(1 - randIndex(test::segmentsOf(result), hand.part) < 0.2);
  CHECK(result.field("normalized") != nullptr);
}

TEST_CASE("the reference gives nearly the same parts as the CPU tracer" * doctest::test_suite("slow")) {
  const Mesh mesh = generateShape("figure", 1500).mesh;
  const Result expected = referenceSession().compute(mesh, withParts()),
               fast = fastSession().compute(mesh, withParts());
  checkReport(expected);
  CHECK(randIndex(test::segmentsOf(expected), test::segmentsOf(fast)) > 0.98);
}

TEST_CASE("a number of parts that components do not allow is a warning") {
  Mesh mesh = generateShape("torus", 400).mesh;
  const Mesh torus = mesh;
  const auto offset = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& v : torus.vertices) mesh.vertices.push_back(v + Vec3d{5, 0, 0});
  for (const auto& [a, b, c] : torus.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  Options options = withParts();
  for (const uint32_t count : {1u, 2u, 6u}) {
    CAPTURE(count);
    options.parts.partCount = count;
    const Result result = fastSession().compute(mesh, options);
    checkReport(result);
    CHECK(result.report.segmentCount == std::max(2u, count));
    CHECK((findWarning(result.report, WarningCode::PartCountDiffers) != nullptr) == (count == 1));
  }
  options.parts.partCount = 100;
  const Result cube = fastSession().compute(makeCube(12).mesh, options);
  CHECK(cube.report.segmentCount == 12);
  CHECK(findWarning(cube.report, WarningCode::PartCountDiffers) != nullptr);
}

TEST_CASE("a mesh of small components only is a warning") {
  const Mesh cube = makeCube(12).mesh;
  Mesh mesh;
  for (uint32_t i = 0; i < 1100; ++i) {
    const auto offset = static_cast<uint32_t>(mesh.vertices.size());
    for (const Vec3d& v : cube.vertices) mesh.vertices.push_back(v + Vec3d{5.0 * i, 0, 0});
    for (const auto& [a, b, c] : cube.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  }
  Options options = withParts();
  options.cone.rayCount = 2;
  const Result result = fastSession().compute(mesh, options);
  const Warning* warning = findWarning(result.report, WarningCode::OnlySmallComponents);
  REQUIRE(warning != nullptr);
  CHECK(warning->message == "no component has 1 % of the area, so each of the 1,100 components is a part");
  CHECK_FALSE(result.report.parts->agreement.has_value());
}

TEST_CASE("a thin shell is a warning") {
  const Result result = fastSession().compute(bowl(), withParts());
  checkReport(result);
  CHECK(result.report.parts->thinShell);
  CHECK(findWarning(result.report, WarningCode::ThinShell) != nullptr);
}

TEST_CASE("shares of the area do not depend on the scale") {
  const Mesh animal = generateShape("animal", 1500).mesh;
  const auto sharesAt = [&](double scale) {
    Mesh mesh = animal;
    for (Vec3d& v : mesh.vertices) v = v * scale;
    const Result result = fastSession().compute(mesh, withParts());
    checkReport(result);
    return result.report.parts->areaShares;
  };
  const std::vector<double> expected = sharesAt(1);
  REQUIRE(expected.size() > 1);
  for (const double scale : {0x1p-531, 0x1p531}) {  // About 1e-160 and 1e160: areas underflow and overflow.
    CAPTURE(scale);
    const std::vector<double> shares = sharesAt(scale);
    REQUIRE(shares.size() == expected.size());
    for (size_t i = 0; i < shares.size(); ++i) CHECK(shares[i] == doctest::Approx(expected[i]).epsilon(1e-6));
  }
}

TEST_CASE("parts of polygons are labels of input faces") {
  const test::QuadCubes cubes(std::array{test::QuadCubes::Cube{1, 0}, test::QuadCubes::Cube{1, 3}});
  const Result result = fastSession().compute(cubes.view(), withParts());
  const Labels& labels = test::segmentsOf(result);
  REQUIRE(labels.size() == 13);
  CHECK(labels[12] == kNoSegment);
  CHECK(result.report.segmentCount == 2);
  CHECK(labels[0] != labels[6]);
  for (size_t face = 0; face < 12; ++face) CHECK(labels[face] == labels[face < 6 ? 0 : 6]);
  CHECK(result.report.parts->areaShares[0] == doctest::Approx(0.5));
}

TEST_CASE("open, non-manifold and degenerate meshes have parts; one triangle has no value") {
  const Mesh sphere = makeSphere(320).mesh;
  Mesh open = sphere;
  open.faces.erase(open.faces.begin(), open.faces.begin() + 40);
  Mesh fin = sphere;
  fin.vertices.push_back({0, 0, 3});
  fin.faces.push_back({fin.faces[0][0], fin.faces[0][1], static_cast<uint32_t>(fin.vertices.size() - 1)});
  Mesh infinite = sphere;
  infinite.vertices[7] = {kNoValue, 0, INFINITY};
  infinite.faces.push_back({1, 1, 2});
  Mesh doubled = sphere;
  doubled.faces.insert(doubled.faces.end(), sphere.faces.begin(), sphere.faces.end());
  for (const Mesh& mesh : {open, fin, infinite, doubled}) {
    CAPTURE(mesh.faces.size());
    const Result result = fastSession().compute(mesh, withParts());
    CHECK(test::segmentsOf(result).size() == mesh.faces.size());
    checkReport(result);
  }
  const Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  requireFailure([&] { (void)fastSession().compute(triangle, withParts()); }, ErrorCode::NoValues);
}

TEST_CASE("a requested stop ends the segmentation") {
  const Mesh mesh = makeSphere(320).mesh;
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  Report report;
  StageClock clock(report.stageSeconds);
  std::stop_source source;
  // Within a line of sight: after the values were checked.
  const LineOfSight stopping = [&](std::span<const LineSegment> segments) {
    source.request_stop();
    return std::vector<uint8_t>(segments.size(), 1);
  };
  requireFailure(
      [&] {
        (void)segmentValues(prepared, std::vector<double>(320, 1.0), withParts(), stopping, clock, report,
                            {source.get_token(), {}});
      },
      ErrorCode::Cancelled);
}

TEST_CASE("options of parts out of range are errors of usage") {
  const Mesh mesh = makeSphere(80).mesh;
  for (const uint32_t count : {0u, 101u}) {
    Options options = withParts();
    options.parts.partCount = count;
    requireFailure([&] { (void)fastSession().compute(mesh, options); }, ErrorCode::OptionOutOfRange,
                   "is not a whole number from 1 to 100");
  }
  for (const double detail : {0.0, 0.09, 10.5, kNoValue}) {
    Options options = withParts();
    options.parts.detail = detail;
    requireFailure([&] { (void)fastSession().compute(mesh, options); }, ErrorCode::OptionOutOfRange,
                   "is not a number from 0.1 to 10");
  }
  Options both = withParts();
  both.parts = {.partCount = 3, .detail = 2};
  requireFailure([&] { (void)fastSession().compute(mesh, both); }, ErrorCode::OptionConflict);
  both.segmentation = Segmentation::None;
  requireFailure([&] { (void)fastSession().compute(mesh, both); }, ErrorCode::OptionConflict,
                 "parts needs segment=parts");
}
