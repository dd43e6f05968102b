#include "asdf_vk/scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "generate/shapes.h"
#include "pipeline/kept_tracers.h"
#include "pipeline/prepared_scene.h"
#include "support/bits.h"
#include "support/quad_cubes.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "trace/scene_data.h"

using namespace asdfvk;
using test::allSeeds;
using test::allSessions;
using test::haveSameBits;
using test::referenceSession;
using test::requireFailure;
using test::vulkanSession;

namespace {

void checkSameFields(const Result& a, const Result& b) {
  REQUIRE(a.fields.size() == b.fields.size());
  for (size_t i = 0; i < a.fields.size(); ++i) {
    CAPTURE(a.fields[i].name);
    CHECK(a.fields[i].name == b.fields[i].name);
    CHECK(a.fields[i].location == b.fields[i].location);
    REQUIRE(a.fields[i].values.index() == b.fields[i].values.index());
    std::visit(
        [&](const auto& entries) {
          CHECK(haveSameBits(entries, std::get<std::decay_t<decltype(entries)>>(b.fields[i].values)));
        },
        a.fields[i].values);
  }
  CHECK(a.report.seedCount == b.report.seedCount);
  CHECK(a.report.rayCount == b.report.rayCount);
  CHECK(a.report.noValueCount == b.report.noValueCount);
  CHECK(a.report.regionFaceCount == b.report.regionFaceCount);
  CHECK(a.report.warnings.size() == b.report.warnings.size());
  if (a.report.estimatedError && b.report.estimatedError)
    CHECK(a.report.estimatedError->average == b.report.estimatedError->average);
}

Options thicknessBelow(double limit) {
  Options options = test::tenthOfFaces();
  options.measure = Measure::Both;
  options.thickness.thinnerThan = limit;
  return options;
}

Options cgal() {
  Options options = test::tenthOfFaces();
  applyDefinition(Definition::Cgal, options);
  return options;
}

Options partsPerVertex() {
  Options options = test::tenthOfFaces();
  options.segmentation = Segmentation::Parts;
  options.per = PerElement::Vertices;
  options.computesCentres = true;
  return options;
}

/// 1 for the faces whose barycentre has x above `limit`.
std::vector<uint8_t> facesBeyond(const Mesh& mesh, double limit) {
  std::vector<uint8_t> region;
  for (const auto [a, b, c] : mesh.faces)
    region.push_back(mesh.vertices[a].x + mesh.vertices[b].x + mesh.vertices[c].x > 3 * limit ? 1 : 0);
  return region;
}

/// Resident memory of this process in bytes.
double residentBytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * 4096;
}

/// The reference, with a count of the tracers that it made.
class CountingBackend final : public Backend {
 public:
  [[nodiscard]] std::string deviceName() const override { return "counting"; }
  [[nodiscard]] std::vector<std::string> deviceLines() const override { return {}; }
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone, const TracerNeeds&,
                                                       std::unique_ptr<EncodedScene>) override {
    ++madeCount;
    return makeReferenceTracer(scene, cone);
  }
  int madeCount = 0;
};

}  // namespace

TEST_CASE("a scene gives the bits of Session::compute for one set of options after another" *
          doctest::test_suite("slow")) {
  const Mesh mesh = makeTorus(1200).mesh;
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    for (const Options& options :
         {test::tenthOfFaces(), cgal(), thicknessBelow(0.4), partsPerVertex(), allSeeds(), test::tenthOfFaces()})
      checkSameFields(scene.compute(options), session->compute(mesh, options));
  }
}

TEST_CASE("the orientation is that of the scene") {
  const Mesh mesh = shapes::inverted(shapes::sphere(3));
  Scene scene(referenceSession(), mesh, Orientation::Auto);
  Options options = test::tenthOfFaces();
  options.orientation = Orientation::Auto;
  const Result expected = referenceSession().compute(mesh, options);
  checkSameFields(scene.compute(test::tenthOfFaces()), expected);
  checkSameFields(scene.compute(options), expected);
  CHECK(scene.compute(test::tenthOfFaces()).reversedFaces == expected.reversedFaces);
  options.orientation = Orientation::Flip;
  requireFailure([&] { (void)scene.compute(options); }, ErrorCode::OptionConflict, "orientation");
}

TEST_CASE("a scene measures its preparation apart from its computations") {
  const Mesh mesh = shapes::sphere(4);
  Scene scene(referenceSession(), mesh);
  const StageSeconds& preparation = scene.preparationSeconds();
  const Report report = scene.compute(test::tenthOfFaces()).report;
  for (const Stage stage : {Stage::Geometry, Stage::Graph, Stage::Bvh}) {
    CHECK(preparation[stage] > 0);
    CHECK(report.stageSeconds[stage] == 0);
  }
  CHECK(preparation[Stage::Trace] == 0);
  CHECK(report.stageSeconds[Stage::Trace] > 0);
}

TEST_CASE("the scene of a picture outlives the Scene that it came from") {
  const Mesh mesh = shapes::sphere(2);
  Options options = test::tenthOfFaces();
  options.keepsScene = true;
  Result result;
  {
    Scene scene(referenceSession(), mesh);
    result = scene.compute(options);
    CHECK(scene.compute(options).scene != nullptr);
  }
  REQUIRE(result.scene != nullptr);
  CHECK(!result.scene->scene.bvh.nodes.empty());
  CHECK(result.scene->scene.geometry.areas.size() == mesh.faces.size());
}

TEST_CASE("invalid meshes and options throw as in Session::compute, and the scene stays usable") {
  requireFailure([&] { Scene scene(referenceSession(), Mesh{}); }, ErrorCode::EmptyMesh);
  const Mesh mesh = shapes::sphere(2);
  Scene scene(referenceSession(), mesh);
  Options options = test::tenthOfFaces();
  options.cone.rayCount = 0;
  requireFailure([&] { (void)scene.compute(options); }, ErrorCode::OptionOutOfRange, "rays: 0 is not");
  std::stop_source source;
  source.request_stop();
  requireFailure([&] { (void)scene.compute({}, {}, {source.get_token(), {}}); }, ErrorCode::Cancelled);
  requireFailure(
      [&] {
        Scene(referenceSession(), mesh, Orientation::Keep, {source.get_token(), {}});
      },
      ErrorCode::Cancelled);
  checkSameFields(scene.compute(test::tenthOfFaces()), referenceSession().compute(mesh, test::tenthOfFaces()));
}

TEST_CASE("a region of all faces gives the bits of the whole mesh") {
  const Mesh mesh = makeTorus(1200).mesh;
  const std::vector<uint8_t> all(mesh.faces.size(), 7);
  Scene scene(vulkanSession(), mesh);
  Options smooth = allSeeds();
  smooth.smoothing.isOn = true;
  for (const Options& options : {test::tenthOfFaces(), cgal(), thicknessBelow(0.4), smooth})
    checkSameFields(scene.compute(options, all), scene.compute(options));
}

TEST_CASE("faces of a region that are traced have the values of the whole mesh, and others none") {
  const Mesh mesh = makeTorus(2000).mesh;
  const std::vector<uint8_t> region = facesBeyond(mesh, 0.3);
  const auto inside = static_cast<uint64_t>(std::count(region.begin(), region.end(), 1));
  REQUIRE(inside > 400);
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    for (Options options : {allSeeds(), cgal(), thicknessBelow(0.4)}) {
      options.seeds = SeedCount::all();
      const Result whole = scene.compute(options), part = scene.compute(options, region);
      CHECK(part.report.faceCount == mesh.faces.size());
      CHECK(part.report.regionFaceCount == inside);
      CHECK(part.report.seedCount == inside);
      CHECK(part.report.noValueCount == 0);
      CHECK(part.report.warnings.empty());
      for (const char* name : {"sdf", "thickness"}) {
        if (whole.field(name) == nullptr) continue;
        const std::vector<double>&a = *whole.field(name)->reals(), &b = *part.field(name)->reals();
        size_t differentCount = 0;
        for (size_t f = 0; f < a.size(); ++f)
          differentCount += region[f] != 0 ? a[f] != b[f] : !std::isnan(b[f]) || part.seed()[f] != 0;
        CHECK(differentCount == 0);
      }
    }
  }
}

TEST_CASE("a share of a region is seeds in it, and the rest of it is interpolated") {
  const Mesh mesh = makeTorus(4000).mesh;
  // Two patches that do not touch.
  std::vector<uint8_t> region = facesBeyond(mesh, 0.5);
  const std::vector<uint8_t> other = facesBeyond(shapes::scaledAndShifted(mesh, -1), 0.9);
  for (size_t f = 0; f < region.size(); ++f) region[f] |= other[f];
  const auto inside = static_cast<uint64_t>(std::count(region.begin(), region.end(), 1));
  Scene scene(referenceSession(), mesh);
  const std::vector<double> exact = scene.compute(allSeeds()).sdf();
  for (const auto& sampler : kSamplerNames) {
    CAPTURE(sampler.first);
    Options options = test::tenthOfFaces();
    options.sampler = sampler.second;
    const Result result = scene.compute(options, region);
    CHECK(result.report.seedCount >= (inside + 5) / 10);
    CHECK(result.report.seedCount <= (inside + 5) / 10 + 2);
    CHECK(result.report.noValueCount == 0);
    CHECK(result.report.regionFaceCount == inside);
    double sum = 0;
    for (size_t f = 0; f < region.size(); ++f) {
      CHECK(std::isnan(result.sdf()[f]) == (region[f] == 0));
      CHECK(std::isnan(test::expectedErrors(result)[f]) == (region[f] == 0));
      if (region[f] == 0) CHECK(result.seed()[f] == 0);
      if (region[f] != 0) sum += std::abs(result.sdf()[f] - exact[f]);
    }
    CHECK(sum / static_cast<double>(inside) < 0.02);  // The values are near 1.
  }
}

TEST_CASE("a component of a region is computed apart from the surface around it") {
  const Mesh mesh = shapes::sphere(4);
  std::vector<uint8_t> region(mesh.faces.size(), 0);
  for (size_t f = 0; f < region.size(); f += 100) region[f] = 1;  // Single faces: each is a component.
  Scene scene(referenceSession(), mesh);
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::ofCount(1);
  const Result result = scene.compute(options, region);
  const auto inside = static_cast<uint64_t>(std::count(region.begin(), region.end(), 1));
  CHECK(result.report.seedCount == inside);
  CHECK(result.report.noValueCount == 0);
}

TEST_CASE("missing values and thin regions are those of the region") {
  // A closed slab, and an open grid beside it without any value.
  const Mesh slab = shapes::box({4, 4, 0.5}, 8);
  const Mesh mesh = shapes::joined(slab, shapes::grid(4), {10, 0, 0});
  std::vector<uint8_t> onSlab(mesh.faces.size(), 0);
  std::fill_n(onSlab.begin(), slab.faces.size(), uint8_t{1});
  Scene scene(referenceSession(), mesh);
  Options options = thicknessBelow(0.6);
  options.seeds = SeedCount::all();
  const Result whole = scene.compute(options), part = scene.compute(options, onSlab);
  CHECK(whole.report.noValueCount == 32);
  CHECK(test::findWarning(whole.report, WarningCode::MissingValues) != nullptr);
  CHECK(part.report.noValueCount == 0);
  CHECK(test::findWarning(part.report, WarningCode::MissingValues) == nullptr);
  CHECK(part.report.thickness->noValueCount == 0);
  // The rim as well: no ball in the slab is larger.
  REQUIRE(part.report.thickness->regions.size() == 1);
  CHECK(part.report.thickness->thinAreaShare == doctest::Approx(1));
  CHECK(part.report.thickness->thinAreaShare > whole.report.thickness->thinAreaShare);

  std::vector<uint8_t> top(mesh.faces.size(), 0);
  for (size_t f = 0; f < slab.faces.size(); ++f)
    top[f] = std::all_of(slab.faces[f].begin(), slab.faces[f].end(),
                         [&](uint32_t v) { return slab.vertices[v].z > 0.2 && slab.vertices[v].x < 0.1; });
  options.seeds = SeedCount::ofShare(0.1);
  const ThicknessReport thin = *scene.compute(options, top).report.thickness;
  REQUIRE(thin.regions.size() == 1);
  CHECK(thin.regions[0].areaShare == doctest::Approx(1));
}

TEST_CASE("a region of polygons has all triangles of its polygons") {
  const test::QuadCubes cubes(std::array{test::QuadCubes::Cube{1, 0}, test::QuadCubes::Cube{2, 10}});
  Scene scene(referenceSession(), cubes.view());
  std::vector<uint8_t> region(13, 0);
  for (const size_t face : {1u, 2u, 8u, 12u}) region[face] = 1;  // The last one has two corners and no triangle.
  const Result whole = scene.compute(allSeeds()), part = scene.compute(allSeeds(), region);
  CHECK(part.report.regionFaceCount == 4);
  CHECK(part.report.seedCount == 6);
  CHECK(part.report.noValueCount == 1);
  for (size_t i = 0; i < 12; ++i) {
    CHECK(part.seed()[i] == region[i]);
    if (region[i] != 0)
      CHECK(part.sdf()[i] == whole.sdf()[i]);
    else
      CHECK(std::isnan(part.sdf()[i]));
  }
}

TEST_CASE("a check of a region compares its faces") {
  const Mesh mesh = makeTorus(2000).mesh;
  Options options = test::tenthOfFaces();
  options.checkCount = 5000;
  Scene scene(vulkanSession(), mesh);
  const std::vector<uint8_t> region = facesBeyond(mesh, 0.3);
  const Result result = scene.compute(options, region);
  REQUIRE(result.report.check);
  CHECK(result.report.check->passed == true);
  CHECK(result.report.check->comparedCount == result.report.regionFaceCount);
}

TEST_CASE("regions of a wrong size or without a face, and options that need the whole mesh, throw") {
  const Mesh mesh = shapes::sphere(2);
  Scene scene(referenceSession(), mesh);
  std::vector<uint8_t> region(mesh.faces.size() - 1, 1);
  requireFailure([&] { (void)scene.compute({}, region); }, ErrorCode::ArraySize, "127 entries");
  region.assign(mesh.faces.size(), 0);
  requireFailure([&] { (void)scene.compute({}, region); }, ErrorCode::EmptyMesh, "no face");
  region[0] = 1;
  for (const Segmentation segmentation : {Segmentation::Parts, Segmentation::Cgal}) {
    Options options = test::tenthOfFaces();
    options.segmentation = segmentation;
    requireFailure([&] { (void)scene.compute(options, region); }, ErrorCode::OptionConflict, "segments");
  }
  Options options = test::tenthOfFaces();
  options.postprocess = Postprocess::Cgal;
  requireFailure([&] { (void)scene.compute(options, region); }, ErrorCode::OptionConflict, "post-process");
  CHECK(scene.compute({}, region).report.seedCount == 1);
}

TEST_CASE("tracers are kept by their cone options, and replaced where they serve less than is needed") {
  const Mesh mesh = shapes::sphere(2);
  StageSeconds seconds;
  StageClock clock(seconds);
  const PreparedScene scene(mesh, Orientation::Keep, clock, {});
  CountingBackend backend;
  KeptTracers tracers(backend, scene.view(), 2);
  ConeOptions narrow, narrower;
  narrow.openingAngleDegrees = 60;
  narrower.openingAngleDegrees = 30;
  const auto made = [&](const ConeOptions& options, const TracerNeeds& needs) {
    (void)tracers.get(options, needs, clock);
    return backend.madeCount;
  };
  CHECK(made({}, {}) == 1);
  CHECK(made({}, {}) == 1);
  CHECK(made({}, {.hits = true}) == 2);
  CHECK(made({}, {}) == 2);  // The new one serves both.
  CHECK(made(narrow, {}) == 3);
  CHECK(made({}, {}) == 3);
  CHECK(made(narrower, {}) == 4);  // Replaces `narrow`, the least recently used one.
  CHECK(made({}, {}) == 4);
  CHECK(made(narrow, {}) == 5);
}

// Slow: sanitizers keep released memory.
TEST_CASE("hundreds of scenes leave no memory behind" * doctest::test_suite("slow")) {
  const Mesh mesh = shapes::sphere(1);
  const std::vector<double> point{1, 0, 0};
  for (const BackendChoice backend : {BackendChoice::Reference, BackendChoice::Cpu}) {
    Session session({.backend = backend});
    const auto runScenes = [&](int count) {
      for (int i = 0; i < count; ++i) {
        Scene scene(session, mesh);
        (void)scene.compute(test::tenthOfFaces());
        (void)scene.valuesAt(point, point);
      }
    };
    runScenes(100);
    const double before = residentBytes();
    runScenes(400);
    CAPTURE(nameOf(kBackendNames, backend));
    CHECK(residentBytes() - before < 4e6);
  }
}
