#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "generate/solids.h"
#include "support/shapes.h"
#include "support/shared_session.h"

// Gaps: the thickness of the space within a body and between bodies (docs/thickness.md#gaps-voids-and-thick-bodies).

using namespace asdfvk;

namespace {

Report measure(const Mesh& mesh, std::optional<double> limit, Orientation orientation = Orientation::Keep) {
  Options options;
  options.measure = Measure::Gap;
  if (limit) options.thickness.closerThan = *limit;
  options.orientation = orientation;
  options.thickness.findsNextWall = true;
  return test::referenceSession().compute(mesh, options).report;
}

/// Two boxes side by side.
Mesh boxesApart(double gap) {
  return shapes::joined(shapes::box({2, 2, 2}, 2), shapes::box({2, 2, 2}, 3), {2 + gap, 0, 0});
}

/// A slab with a slot from above, as an extruded U; walls of 1.
Mesh slotted(double width) {
  const double w = width / 2;
  const std::vector<Vec3d> outline{{-w - 1, 0, 0}, {w + 1, 0, 0}, {w + 1, 3, 0}, {w, 3, 0},
                                   {w, 1, 0},      {-w, 1, 0},    {-w, 3, 0},    {-w - 1, 3, 0}};
  Mesh mesh;
  for (const double z : {0.0, 4.0})
    for (const Vec3d& p : outline) mesh.vertices.push_back({p.x, p.y, z});
  const std::vector<Face> lid{{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}};
  for (const auto& [a, b, c] : lid) {
    mesh.faces.push_back({a, c, b});
    mesh.faces.push_back({a + 8, b + 8, c + 8});
  }
  for (uint32_t i = 0; i < 8; ++i) {
    const uint32_t j = (i + 1) % 8;
    mesh.faces.push_back({i, j, j + 8});
    mesh.faces.push_back({i, j + 8, i + 8});
  }
  return mesh;
}

}  // namespace

TEST_CASE("a clearance between two bodies is a gap, on both sides of the limit, in each triangulation") {
  for (const double gap : {0.1, 0.5, 1.5})
    for (Mesh mesh : {boxesApart(gap), solids::separated(boxesApart(gap)),
                      shapes::scaledAndShifted(boxesApart(gap), 25.4, {1000, -500, 30})}) {
      CAPTURE(gap);
      const double scale = mesh.vertices[0].x < -100 || mesh.vertices[0].x > 100 ? 25.4 : 1;
      const Report failed = measure(mesh, 1.01 * gap * scale), passed = measure(mesh, 0.99 * gap * scale);
      CHECK(failed.gap->verdict == ThicknessVerdict::Failed);
      CHECK(passed.gap->verdict == ThicknessVerdict::Passed);
      REQUIRE(failed.gap->regions.size() == 1);
      const ThinRegion& region = failed.gap->regions[0];
      CHECK(region.kind == ThinKind::Gap);
      CHECK(region.min == doctest::Approx(gap * scale).epsilon(1e-5));
      CHECK(length(region.place - region.opposite) == doctest::Approx(gap * scale).epsilon(1e-5));
      CHECK(region.area == doctest::Approx(8 * scale * scale).epsilon(1e-5));
      REQUIRE(region.oppositeFace);
      const bool isOfSecond = region.minFace >= 48;
      CHECK(region.bodies == std::vector<std::string>{isOfSecond ? "component 1" : "component 0",
                                                      isOfSecond ? "component 0" : "component 1"});
      CHECK((region.minFace < 48) != (*region.oppositeFace < 48));
      CHECK(passed.gap->min == doctest::Approx(gap * scale).epsilon(1e-5));
      CHECK(failed.contacts.empty());
      CHECK(failed.voids.empty());
    }
}

TEST_CASE("a slot is a gap of one body, and its mouth does not matter") {
  const Mesh mesh = slotted(0.4);
  const Report failed = measure(mesh, 0.5), passed = measure(mesh, 0.3);
  CHECK(failed.gap->verdict == ThicknessVerdict::Failed);
  REQUIRE(failed.gap->regions.size() == 1);
  CHECK(failed.gap->regions[0].min == doctest::Approx(0.4));
  CHECK(failed.gap->regions[0].bodies.empty());
  CHECK(passed.gap->verdict == ThicknessVerdict::Passed);
  CHECK(passed.gap->min == doctest::Approx(0.4).epsilon(0.05));
}

TEST_CASE("a convex body has no gap, and passes") {
  const Report report = measure(shapes::cube(), 0.5);
  CHECK(report.gap->verdict == ThicknessVerdict::Passed);
  CHECK(std::isnan(report.gap->min));
  CHECK(report.gap->noValueCount == 12);
  CHECK(report.voids.empty());
  CHECK(report.gap->sentence == "PASS: no gap closer than 0.5");
}

TEST_CASE("bodies in contact have no gap of width 0, and are named") {
  for (const double overlap : {0.0, 0.25}) {
    const Mesh mesh = boxesApart(-overlap);
    CAPTURE(overlap);
    for (const Mesh& each : {mesh, solids::separated(mesh)}) {
      const Report report = measure(each, 0.5);
      CHECK(report.gap->verdict == ThicknessVerdict::Passed);
      REQUIRE(report.contacts.size() == 1);
      CHECK(report.contacts[0].bodies == std::vector<std::string>{"component 0", "component 1"});
    }
  }
}

TEST_CASE("a body in the material of another one is in contact with it, and a body in a void is not") {
  const Mesh outer = shapes::box({10, 10, 10}), cavity = shapes::inverted(shapes::box({6, 6, 6})),
             inner = shapes::box({4, 4, 4}), core = shapes::box({2, 2, 2});
  const auto contactsOf = [](const Mesh& mesh) {
    std::vector<std::vector<std::string>> names;
    for (const BodyContact& contact : measure(mesh, 0.5).contacts) names.push_back(contact.bodies);
    return names;
  };
  using Names = std::vector<std::vector<std::string>>;
  Mesh solid = shapes::joined(outer, inner);
  CHECK(contactsOf(solid) == Names{{"component 0", "component 1"}});
  solid.objects = {{0, "plate"}, {12, "pin"}};
  CHECK(contactsOf(solid) == Names{{"plate", "pin"}});
  CHECK(contactsOf(shapes::joined(solid, core)).size() == 2);
  CHECK(contactsOf(shapes::joined(outer, cavity)).empty());
  const Mesh hollow = shapes::joined(outer, cavity);
  CHECK(contactsOf(shapes::joined(hollow, inner)).empty());
  CHECK(contactsOf(shapes::joined(shapes::joined(hollow, inner), core)) == Names{{"component 2", "component 3"}});
}

TEST_CASE("where two bodies approach a contact, there is no gap that counts") {
  // A ball on a plate: an edge, and near the contact a detail, because the ball is flat there.
  const Mesh mesh = shapes::joined(shapes::box({6, 6, 1}, 4), shapes::icosphere(4), {0, 0, 1.5 + 1e-9});
  const Report report = measure(mesh, 0.1);
  CHECK(report.gap->verdict == ThicknessVerdict::Passed);
  for (const ThinRegion& region : report.gap->regions) CHECK(region.kind != ThinKind::Gap);
  Options options;
  options.thickness.closerThan = 0.1;
  options.thickness.countsEdges = true;
  CHECK(test::referenceSession().compute(mesh, options).report.gap->verdict == ThicknessVerdict::Failed);
}

TEST_CASE("gaps of a mesh that is open, inverted or wound inconsistently are not judged") {
  CHECK(measure(shapes::openBox({2, 2, 2}, 2), 0.5).gap->verdict == ThicknessVerdict::NotJudged);
  CHECK(measure(shapes::inverted(shapes::cube()), 0.5).gap->verdict == ThicknessVerdict::NotJudged);
  CHECK(measure(shapes::inverted(shapes::cube()), 0.5, Orientation::Auto).gap->verdict == ThicknessVerdict::Passed);
  Mesh mixed = shapes::cube();
  std::swap(mixed.faces[7][0], mixed.faces[7][1]);
  CHECK(measure(mixed, 0.5).gap->verdict == ThicknessVerdict::NotJudged);
  CHECK(measure(mixed, 0.5, Orientation::Auto).gap->verdict == ThicknessVerdict::Passed);
}

TEST_CASE("thickness and gap of one computation equal those of two") {
  const Mesh mesh = slotted(0.4);
  Options options;
  options.thickness.closerThan = 0.5;
  options.thickness.thinnerThan = 1.2;
  const Result both = test::referenceSession().compute(mesh, options);
  CHECK(options.measure == Measure::ShapeDiameter);
  CHECK(both.report.thickness->verdict == ThicknessVerdict::Failed);
  CHECK(both.report.gap->verdict == ThicknessVerdict::Failed);
  CHECK(both.report.seedCount == 0);
  options.thickness.closerThan.reset();
  const Result walls = test::referenceSession().compute(mesh, options);
  CHECK(*both.field("thickness")->reals() == *walls.field("thickness")->reals());
  CHECK(walls.field("gap") == nullptr);
  CHECK_FALSE(walls.report.gap);
  // The triangles of the gaps refer to regions after those of the walls.
  const size_t wallCount = both.report.thickness->regions.size(), gapCount = both.report.gap->regions.size();
  const auto& regions = both.thinSurface.regions;
  CHECK(*std::max_element(regions.begin(), regions.end()) == wallCount + gapCount - 1);
  CHECK(std::count_if(regions.begin(), regions.end(), [&](uint32_t region) { return region < wallCount; }) ==
        static_cast<ptrdiff_t>(walls.thinSurface.regions.size()));
}

TEST_CASE("the gap has the same values as the thickness of the reversed mesh") {
  const Mesh mesh = boxesApart(0.5);
  Options options;
  options.measure = Measure::Gap;
  const Result gap = test::referenceSession().compute(mesh, options);
  options.measure = Measure::Thickness;
  options.orientation = Orientation::Flip;
  const Result flipped = test::referenceSession().compute(mesh, options);
  const std::vector<double>&found = *gap.field("least_gap")->reals(),
        &expected = *flipped.field("least_thickness")->reals();
  REQUIRE(found.size() == expected.size());
  for (size_t face = 0; face < found.size(); ++face) {
    CAPTURE(face);
    const bool isEqual = found[face] == expected[face] || (std::isnan(found[face]) && std::isnan(expected[face]));
    CHECK(isEqual);
  }
}
