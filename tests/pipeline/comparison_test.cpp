// Comparison of two versions of a mesh (docs/thickness.md#two-versions).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/scene.h"
#include "core/vec3.h"
#include "generate/extrusion.h"

#include "generate/solids.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"

using namespace asdfvk;

namespace {

Result compareVersionsOf(const Mesh& mesh, const Mesh& former, std::optional<double> limit, Options options = {}) {
  options.measure = Measure::Thickness;
  if (limit) options.thickness.thinnerThan = *limit;
  Scene before(test::referenceSession(), former), now(test::referenceSession(), mesh);
  return now.compare(before, options);
}

/// A plate of 10 x 10, centred.
Mesh plate(double thickness, uint32_t side = 4) { return shapes::box({10, 10, thickness}, side); }

/// Two plates, 20 apart.
Mesh platesOf(double first, double second) { return shapes::joined(plate(first), plate(second), {20, 0, 0}); }

std::vector<uint64_t> countsOf(const ComparisonReport& report) {
  return {report.newCount, report.thinnerCount, report.keptCount, report.goneCount};
}
using Counts = std::vector<uint64_t>;

}  // namespace

TEST_CASE("a version that is only triangulated differently has no change, on both sides of the limit") {
  const Mesh former = plate(1, 1);
  for (const Mesh& mesh : {plate(1, 7), solids::separated(plate(1, 1)), solids::refined(plate(1, 2), 0.7)})
    for (const double limit : {0.9, 1.1}) {
      CAPTURE(limit);
      const Result result = compareVersionsOf(mesh, former, limit);
      const ComparisonReport& comparison = result.report.comparison.value();
      CHECK(comparison.verdict == ThicknessVerdict::Passed);
      CHECK(result.report.thickness->verdict == (limit < 1 ? ThicknessVerdict::Passed : ThicknessVerdict::Failed));
      CHECK(comparison.formerVerdict == result.report.thickness->verdict);
      CHECK(countsOf(comparison) == Counts{0, 0, limit < 1 ? 0u : 1u, 0});
      CHECK(comparison.unmatchedFaceCount == 0);
      CHECK(comparison.thinner.empty());
      const std::vector<double>& change = *result.field("thickness_change")->reals();
      REQUIRE(change.size() == mesh.faceCount());
      for (const double value : change) CHECK(std::abs(value) < 1e-6);
    }
}

TEST_CASE("a wall is new, thinner, kept or gone") {
  const auto check = [](const Mesh& mesh, const Mesh& former, const Counts& counts, ThicknessVerdict verdict) {
    const Result result = compareVersionsOf(mesh, former, 0.8);
    CHECK(countsOf(*result.report.comparison) == counts);
    CHECK(result.report.comparison->verdict == verdict);
    CHECK(result.report.comparison->gone.size() == counts[3]);
  };
  using enum ThicknessVerdict;
  check(platesOf(0.5, 2), platesOf(2, 2), {1, 0, 0, 0}, Failed);
  check(platesOf(0.5, 0.7), platesOf(0.5, 2), {1, 0, 1, 0}, Failed);
  check(platesOf(0.5, 2), platesOf(0.7, 2), {0, 1, 0, 0}, Failed);
  check(platesOf(0.69, 2), platesOf(0.7, 2), {0, 0, 1, 0}, Passed);
  check(platesOf(0.7, 2), platesOf(0.5, 2), {0, 0, 1, 0}, Passed);
  check(platesOf(0.5, 2), platesOf(0.5, 0.5), {0, 0, 1, 1}, Passed);
  check(platesOf(2, 2), platesOf(0.5, 0.5), {0, 0, 0, 2}, Passed);
  check(plate(0.5), shapes::box({10, 10, 10}), {1, 0, 0, 0}, Failed);
  // The other plate is elsewhere.
  check(shapes::scaledAndShifted(plate(0.5), 1, {0, 0, 3}), plate(0.5), {1, 0, 0, 1}, Failed);
  // One side of the plate moved.
  check(shapes::scaledAndShifted(plate(0.3), 1, {0, 0, 0.2}), plate(0.7), {0, 1, 0, 0}, Failed);
}

TEST_CASE("a part of a wall can be new, or thinner, and the place of the change is reported") {
  const auto profile = [](double thickness, double finHeight) {
    solids::Outline outline{{0, 0}, {20, 0}, {20, thickness}};
    if (finHeight > 0)
      outline.insert(outline.end(),
                     {{10.7, thickness}, {10.7, thickness + finHeight}, {10, thickness + finHeight}, {10, thickness}});
    outline.push_back({0, thickness});
    return solids::extruded(outline, 20);
  };
  const auto regionOf = [](const Mesh& mesh, const Mesh& former) {
    const Report report = compareVersionsOf(mesh, former, 0.8).report;
    CHECK(report.comparison->verdict == ThicknessVerdict::Failed);
    for (const ThinRegion& region : report.thickness->regions)
      if (region.change && region.change != WallChange::Kept) return region;
    FAIL("no change");
    return ThinRegion();
  };
  // A fin on a plate that was thin before, and a fin that became higher.
  const ThinRegion added = regionOf(profile(0.7, 9), profile(0.7, 0)), higher = regionOf(profile(5, 20), profile(5, 5));
  CHECK(added.change == WallChange::New);
  CHECK(higher.change == WallChange::New);
  for (const ThinRegion& region : {added, higher}) {
    REQUIRE(region.changedPlace);
    CHECK(region.changedPlace->thickness == doctest::Approx(0.7).epsilon(1e-3));
    CHECK_FALSE(region.changedPlace->formerThickness);
    CHECK(region.changedPlace->place.y > 0.8);
  }
  CHECK(compareVersionsOf(profile(0.7, 0), profile(0.7, 9), 0.8).report.comparison->verdict ==
        ThicknessVerdict::Passed);
  CHECK(compareVersionsOf(profile(5, 5), profile(5, 20), 0.8).report.comparison->verdict == ThicknessVerdict::Passed);
  // A groove in a plate. The thinnest place of the region is elsewhere.
  const auto grooved = [](double depth) {
    return solids::extruded({{0, 0},
                             {40, 0},
                             {40, 0.7},
                             {33, 0.7},
                             {33, 0.7 - depth},
                             {30, 0.7 - depth},
                             {30, 0.7},
                             {10, 0.7},
                             {10, 0.3},
                             {0, 0.3}},
                            20);
  };
  const ThinRegion groove = regionOf(grooved(0.3), grooved(0.01));
  CHECK(groove.change == WallChange::Thinner);
  REQUIRE(groove.changedPlace);
  CHECK(groove.changedPlace->thickness == doctest::Approx(0.4).epsilon(1e-3));
  CHECK(groove.changedPlace->formerThickness.value() == doctest::Approx(0.69).epsilon(1e-3));
  CHECK(std::abs(groove.changedPlace->place.x - 31.5) < 1.5);
}

TEST_CASE("walls that taper, and bodies without opposite walls, do not change with their triangulation") {
  const Mesh blade = solids::extruded({{0, -0.3}, {9, -0.05}, {9, 0.05}, {0, 0.3}}, 10),
             prism = solids::extruded({{0, 0}, {4, 0}, {0, 4}}, 9);
  for (const Mesh& mesh : {blade, prism}) {
    const Mesh fine = solids::refined(mesh, 0.4);
    for (const double limit : {0.3, 0.55, 2.0, 2.9})
      for (const bool isFiner : {false, true}) {
        CAPTURE(limit);
        const Report report = compareVersionsOf(isFiner ? fine : mesh, isFiner ? mesh : fine, limit).report;
        CHECK(report.comparison->verdict == ThicknessVerdict::Passed);
        CHECK(report.comparison->newCount + report.comparison->thinnerCount == 0);
        CHECK(report.comparison->thinnerArea == 0);
      }
  }
}

TEST_CASE("a former version without a known inside, or elsewhere, gives no FAIL") {
  const Mesh thin = plate(0.5);
  const auto verdictAgainst = [&](const Mesh& former) {
    return compareVersionsOf(thin, former, 0.8).report.comparison->verdict.value();
  };
  Mesh inverted = thin, empty = thin;
  for (Face& face : inverted.faces) std::swap(face[1], face[2]);
  for (Vec3d& vertex : empty.vertices) vertex = {};
  CHECK(verdictAgainst(inverted) == ThicknessVerdict::NotJudged);
  CHECK(verdictAgainst(shapes::joined(thin, inverted, {})) == ThicknessVerdict::NotJudged);
  CHECK(verdictAgainst(empty) == ThicknessVerdict::NotJudged);
  CHECK(verdictAgainst(shapes::openBox({10, 10, 10}, 2)) == ThicknessVerdict::NotJudged);
  const Report report = compareVersionsOf(plate(2), shapes::scaledAndShifted(plate(2), 1e-3, {}), 0.8).report;
  CHECK(report.comparison->matchedFaceCount == 0);
  CHECK(report.comparison->verdict == ThicknessVerdict::NotJudged);
}

TEST_CASE("a fin between other fins is new") {
  Mesh former, mesh;
  for (const double x : {0.0, 0.7, 1.4}) former = shapes::joined(former, shapes::box({0.2, 5, 5}), {x, 0, 0});
  mesh = shapes::joined(former, shapes::box({0.1, 5, 5}), {0.35, 0, 0});
  CHECK(countsOf(*compareVersionsOf(mesh, former, 0.3).report.comparison) == Counts{1, 0, 3, 0});
  CHECK(countsOf(*compareVersionsOf(former, mesh, 0.3).report.comparison) == Counts{0, 0, 3, 1});
}

TEST_CASE("without a limit, the thinner part of the surface is reported with its area and place") {
  const Mesh former = platesOf(3, 3), mesh = platesOf(3, 2);
  const Result result = compareVersionsOf(mesh, former, {});
  const ComparisonReport& comparison = *result.report.comparison;
  CHECK_FALSE(comparison.verdict);
  CHECK_FALSE(comparison.formerVerdict);
  CHECK(countsOf(comparison) == Counts{0, 0, 0, 0});
  // The plate is one region: its greatest section also limits the thickness of its narrow sides.
  REQUIRE(comparison.thinner.size() == 1);
  const ThinnerRegion& region = comparison.thinner[0];
  CHECK(region.thickness == doctest::Approx(2).epsilon(2e-3));
  CHECK(region.formerThickness == doctest::Approx(3).epsilon(2e-3));
  CHECK(region.area == doctest::Approx(200 + 40 * 2).epsilon(1e-6));
  CHECK(region.faceCount == plate(2).faceCount());
  CHECK(region.face >= plate(2).faceCount());
  CHECK(region.place.x > 10);
  CHECK(comparison.thinnerAreaShare == doctest::Approx(280.0 / (280 + 200 + 40 * 3)).epsilon(1e-6));
  const std::vector<double>& change = *result.field("thickness_change")->reals();
  CHECK(*std::min_element(change.begin(), change.end()) == doctest::Approx(-1).epsilon(2e-3));
  CHECK(std::abs(*std::max_element(change.begin(), change.end())) < 1e-6);
}

TEST_CASE("a part of the mesh that the former version does not have has no change") {
  const Result result = compareVersionsOf(platesOf(2, 2), plate(2), {});
  const ComparisonReport& comparison = *result.report.comparison;
  CHECK(comparison.unmatchedFaceCount == plate(2).faceCount());
  CHECK(comparison.thinner.empty());
}

TEST_CASE("details and edges are compared if they count") {
  Options options;
  options.thickness.countsEdges = true;
  const Mesh wedge = solids::extruded({{0, 0}, {10, 0}, {0, 8}}, 10), box = shapes::box({10, 10, 10});
  const Result result = compareVersionsOf(wedge, box, 0.5, options);
  CHECK(result.report.comparison->newCount > 0);
  CHECK(result.report.comparison->verdict == ThicknessVerdict::Failed);
  CHECK(compareVersionsOf(wedge, wedge, 0.5, options).report.comparison->verdict == ThicknessVerdict::Passed);
  CHECK(compareVersionsOf(wedge, box, 0.5).report.comparison->verdict == ThicknessVerdict::Passed);
}

TEST_CASE("what cannot be judged is told, and the former version may be open") {
  const Mesh open = shapes::openBox({10, 10, 10}, 2);
  CHECK(compareVersionsOf(open, plate(1), 0.5).report.comparison->verdict == ThicknessVerdict::NotJudged);
  const Result result = compareVersionsOf(plate(1), open, 0.5);
  CHECK(result.report.comparison->verdict == ThicknessVerdict::Passed);
  CHECK(result.report.comparison->formerVerdict == ThicknessVerdict::NotJudged);
  const std::string sentence = compareVersionsOf(plate(0.4), open, 0.5).report.comparison->sentence;
  CHECK_MESSAGE(sentence.starts_with("NOT JUDGED: 1 new wall (limit 0.5): 0.4 at ("), sentence);
  CHECK_MESSAGE(sentence.ends_with("; the former version cannot be judged"), sentence);
}

TEST_CASE("a comparison is independent of the unit and of the size of the other version") {
  for (const double scale : {1e-3, 1e3}) {
    const Mesh mesh = shapes::scaledAndShifted(platesOf(0.5, 2), scale, {3 * scale, 0, 0}),
               former = shapes::scaledAndShifted(shapes::joined(platesOf(0.7, 2), plate(4), {80, 0, 0}), scale,
                                                 {3 * scale, 0, 0});
    CHECK(countsOf(*compareVersionsOf(mesh, former, 0.8 * scale).report.comparison) == Counts{0, 1, 0, 0});
  }
}

TEST_CASE("meshes with different units are not compared") {
  Mesh mesh = plate(1), former = plate(1);
  mesh.unit = "in";
  former.unit = "mm";
  test::requireFailure([&] { (void)compareVersionsOf(mesh, former, 1); }, ErrorCode::UnitsDiffer,
                       "one mesh has the unit in");
  former.unit = "";
  test::requireFailure([&] { (void)compareVersionsOf(mesh, former, 1); }, ErrorCode::UnitsDiffer, "states no unit");
  mesh.unit = "mm";
  CHECK(compareVersionsOf(mesh, former, 0.5).report.comparison->verdict == ThicknessVerdict::Passed);
}

TEST_CASE("a region is compared with the whole former version") {
  const Mesh mesh = platesOf(0.5, 0.5), former = platesOf(0.5, 2);
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = 0.8;
  std::vector<uint8_t> region(mesh.faceCount(), 0);
  std::fill_n(region.begin(), plate(1).faceCount(), uint8_t{1});
  Scene before(test::referenceSession(), former), now(test::referenceSession(), mesh);
  CHECK(countsOf(*now.compare(before, options, region).report.comparison) == Counts{0, 0, 1, 0});
  Scene same(test::referenceSession(), mesh);  // The other wall is no longer asked for, but not gone.
  CHECK(countsOf(*now.compare(same, options, region).report.comparison) == Counts{0, 0, 1, 0});
  CHECK(countsOf(*now.compare(before, options).report.comparison) == Counts{1, 0, 1, 0});
}
