#include "pipeline/thickness.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "generate/shapes.h"
#include "support/require_failure.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::allSeeds;
using test::referenceSession;
using test::requireFailure;
using test::vulkanSession;

namespace {

Options thickness(std::optional<double> limit = {}, SeedCount seeds = SeedCount::all()) {
  Options options;
  options.seeds = seeds;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  return options;
}

const std::vector<double>& thicknessOf(const Result& result, const char* name = "thickness") {
  const Field* field = result.field(name);
  REQUIRE(field != nullptr);
  CHECK(field->unit == "length");
  return *field->reals();
}

constexpr double kThick = 0.4, kThin = 0.1;

/// A slab of width 2 and thickness 0.4, 0.1 thick above a dent in its bottom: |x|, |y| < 0.4.
Mesh dentedSlab(uint64_t faceCount = 3000) {
  Mesh mesh = makeSlab(faceCount, 2, kThick).mesh;
  for (Vec3d& v : mesh.vertices)
    if (v.z < 0 && std::max(std::abs(v.x), std::abs(v.y)) < 0.4) v.z = kThick / 2 - kThin;
  return mesh;
}

}  // namespace

TEST_CASE("the shape diameter and the seeds have the same bits with and without the thickness") {
  const Mesh mesh = makeAnimal(3000).mesh;
  for (Session* session : {&referenceSession(), &vulkanSession()})
    for (const SeedCount& seeds : {SeedCount::all(), SeedCount::ofShare(0.1)})
      for (const Definition definition : {Definition::Paper, Definition::Cgal}) {
        Options plain;
        applyDefinition(definition, plain);
        plain.seeds = seeds;
        Options measured = plain;
        measured.measure = Measure::Both;
        measured.thickness.thinnerThan = 0.3;
        const Result expected = session->compute(mesh, plain), found = session->compute(mesh, measured);
        CHECK(found.sdf() == expected.sdf());
        CHECK(found.seed() == expected.seed());
        CHECK(expected.field("thickness") == nullptr);
        CHECK_FALSE(expected.report.thickness.has_value());
      }
}

TEST_CASE("the thickness alone casts no ray, and has the bits of the thickness beside the diameter") {
  const Mesh mesh = makeHand(4000).mesh;
  Options alone = thickness(0.3), both = thickness(0.3);
  both.measure = Measure::Both;
  for (Session* session : {&referenceSession(), &vulkanSession()}) {
    CAPTURE(session->backend());
    const Result found = session->compute(mesh, alone), expected = session->compute(mesh, both);
    for (const char* name : {"thickness", "least_thickness"})
      CHECK(thicknessOf(found, name) == thicknessOf(expected, name));
    CHECK(found.fields.size() == 2);
    CHECK(found.report.thickness->regions.size() == expected.report.thickness->regions.size());
    CHECK(found.report.rayCount == 0);
    CHECK(found.report.stageSeconds[Stage::Trace] == 0);
    CHECK(expected.report.rayCount > 0);
    for (const auto& read :
         {+[](const Result& result) { (void)result.sdf(); }, +[](const Result& result) { (void)result.seed(); }})
      requireFailure([&] { read(found); }, ErrorCode::UnknownField);
  }
}

TEST_CASE("what needs the diameter measures it beside the thickness") {
  const Mesh mesh = makeHand(2000).mesh;
  const auto isMeasured = [&](const auto& change) {
    Options options = thickness();
    change(options);
    const Result result = referenceSession().compute(mesh, options);
    return result.field("sdf") != nullptr && result.field("thickness") != nullptr;
  };
  CHECK(isMeasured([](Options& o) { o.segmentation = Segmentation::Parts; }));
  CHECK(isMeasured([](Options& o) { o.postprocess = Postprocess::Cgal; }));
  CHECK(isMeasured([](Options& o) { o.computesCentres = true; }));
  CHECK(isMeasured([](Options& o) { o.checkCount = 5; }));
  CHECK(isMeasured([](Options& o) {
    o.seeds = SeedCount::ofShare(0.02);
    o.rounds.maxError = 0.1;
  }));
  CHECK_FALSE(isMeasured([](Options&) {}));
}

TEST_CASE("backends agree in the thickness, by both definitions of the rays") {
  const Mesh mesh = makeHand(4000).mesh;
  for (const Definition definition : {Definition::Paper, Definition::Cgal}) {
    Options options = thickness();
    applyDefinition(definition, options);
    options.seeds = SeedCount::all();
    const Result expected = referenceSession().compute(mesh, options), found = vulkanSession().compute(mesh, options);
    const double range = expected.report.thickness->max;
    size_t differentCount = 0;
    for (size_t i = 0; i < mesh.faces.size(); ++i)
      differentCount += std::abs(thicknessOf(expected)[i] - thicknessOf(found)[i]) <= 1e-5 * range ? 0 : 1;
    CHECK(differentCount <= mesh.faces.size() / 1000);
  }
}

TEST_CASE("the dent of a slab and the face above it are one region") {
  const Mesh mesh = dentedSlab();
  for (Session* session : {&referenceSession(), &vulkanSession()}) {
    const Result result = session->compute(mesh, thickness(0.2));
    const ThicknessReport& report = result.report.thickness.value();
    REQUIRE(report.regions.size() == 1);
    const ThinRegion& region = report.regions[0];
    CHECK(region.kind == ThinKind::Wall);
    CHECK(region.min == doctest::Approx(kThin).epsilon(1e-6));
    CHECK(std::max(std::abs(region.place.x), std::abs(region.place.y)) < 0.45);
    CHECK(thicknessOf(result, "least_thickness")[region.minFace] == doctest::Approx(region.min).epsilon(1e-6));
    CHECK(length(region.place - region.opposite) == doctest::Approx(kThin).epsilon(1e-6));
    CHECK(region.area > 1);    // The dent is 0.8 wide, without its slopes.
    CHECK(region.area < 2.6);  // Up to 0.1 beside it the balls touch the rim of the dent; whole faces count.
    CHECK(region.areaShare == doctest::Approx(region.area / 11.2).epsilon(0.05));
    CHECK(report.thinArea == doctest::Approx(region.area));
    const auto& values = thicknessOf(result, "least_thickness");
    CHECK(std::count_if(values.begin(), values.end(), [](double v) { return v < 0.999 * 0.2; }) ==
          static_cast<std::ptrdiff_t>(region.faceCount));
    CHECK(report.min == doctest::Approx(kThin).epsilon(1e-6));
    CHECK(report.median == doctest::Approx(kThick).epsilon(1e-6));
  }
  const Result none = referenceSession().compute(mesh, thickness(0.05));
  CHECK(none.report.thickness->regions.empty());
  CHECK(none.report.thickness->thinArea == 0);
}

TEST_CASE("percentiles are by area") {
  // A wedge is 0.2 to 0.4 thick. Half of its area is beyond its middle; its ends count up to its section.
  const Mesh wedge = [] {
    Mesh mesh = makeSlab(20000, 2, 0.4).mesh;
    for (Vec3d& v : mesh.vertices) v.z *= 0.75 + 0.25 * v.x;
    return mesh;
  }();
  const Result result = referenceSession().compute(wedge, thickness());
  const ThicknessReport& report = result.report.thickness.value();
  CHECK(report.percentile5 == doctest::Approx(0.21).epsilon(0.05));
  CHECK(report.median == doctest::Approx(0.3).epsilon(0.05));
  CHECK(report.max == doctest::Approx(0.4).epsilon(0.02));
  REQUIRE(report.greatestSection.has_value());
  CHECK(report.max <= report.greatestSection->diameter * 1.001);
  CHECK(report.greatestSection->centre.x > 0.7);
  CHECK(report.noValueCount == 0);
  CHECK_FALSE(report.thinnerThan.has_value());
}

TEST_CASE("a polygon has the least thickness of its triangles, which is reported once") {
  // A wedge of quads: each side is one polygon, whose two triangles differ in thickness.
  const std::vector<double> positions{0, 0, 0, 4, 0, 0, 4, 2, 0, 0, 2, 0, 0, 0, 1, 4, 0, 0.5, 4, 2, 0.5, 0, 2, 1};
  const std::vector<uint32_t> corners{3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 1, 2, 6, 5, 3, 0, 4, 7};
  const std::vector<uint64_t> firstCorner{0, 4, 8, 12, 16, 20, 24};
  const Result result = referenceSession().compute(MeshView(positions, corners, firstCorner), thickness(0.9));
  const std::vector<double>& values = thicknessOf(result, "least_thickness");
  REQUIRE(values.size() == 6);
  CHECK(values[0] == doctest::Approx(0.5).epsilon(0.01));
  CHECK(thicknessOf(result)[0] < 0.7);  // 4 / 3 from the thin end: about 0.65.
  CHECK(thicknessOf(result)[0] > 0.6);
  const ThicknessReport& report = result.report.thickness.value();
  REQUIRE(report.regions.size() == 1);
  CHECK(report.regions[0].faceCount == 2);
  CHECK(values[report.regions[0].minFace] == doctest::Approx(report.regions[0].least));
  CHECK(report.regions[0].min > report.regions[0].least);  // The wall tapers.
}

TEST_CASE("degenerate faces and faces without a valid ray have no thickness") {
  Mesh mesh = makeSphere(500).mesh;
  mesh.faces.push_back({0, 0, 1});
  for (const SeedCount& seeds : {SeedCount::all(), SeedCount::ofShare(0.2)}) {
    const Result result = referenceSession().compute(mesh, thickness(0.1, seeds));
    CHECK(std::isnan(thicknessOf(result).back()));
    CHECK(result.report.thickness->noValueCount == 1);
    CHECK(result.report.thickness->regions.empty());
  }
  const Mesh open{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  const Result none = referenceSession().compute(open, thickness(1));
  CHECK(std::isnan(none.report.thickness->min));
  CHECK(none.report.thickness->regions.empty());
}

TEST_CASE("options out of range are refused") {
  const Mesh mesh = makeSphere(200).mesh;
  Options options = thickness();
  for (const double angle : {90.0, 181.0}) {
    options.thickness.wallAngleDegrees = angle;
    requireFailure([&] { (void)referenceSession().compute(mesh, options); }, ErrorCode::OptionOutOfRange,
                   "is not a number above 90 and at most 180");
  }
  for (const double limit : {0.0, -1.0, std::nan("")})
    requireFailure([&] { (void)referenceSession().compute(mesh, thickness(limit)); }, ErrorCode::OptionOutOfRange);
  Options plain = allSeeds();
  plain.thickness.thinnerThan = 1;
  CHECK(referenceSession().compute(mesh, plain).report.thickness.has_value());  // The limit implies the measure.
  plain.thickness = {.wallAngleDegrees = 100};
  requireFailure([&] { (void)referenceSession().compute(mesh, plain); }, ErrorCode::OptionConflict,
                 "needs measure=thickness");
}
