#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "asdf_vk/scene.h"
#include "generate/block_solid.h"
#include "generate/thickness_parts.h"
#include "mesh/face_geometry.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "wall_check.h"

// The verdict of the wall check, and the faces that it does not judge.

using namespace asdfvk;
using test::check;
using test::limitedTo;
using test::referenceSession;

namespace {

/// Coordinates as STL files have them.
Mesh inFloat32(Mesh mesh) {
  for (Vec3d& v : mesh.vertices) v = Vec3d(Vec3f(v));
  return mesh;
}

Mesh part(const char* name, double longestEdge = 1e9) {
  return makeThicknessPart(name).solid.surface({.longestEdge = longestEdge});
}

}  // namespace

TEST_CASE("an open mesh is not judged where it has no thickness, and fails where it is thin") {
  const Mesh box = shapes::openBox({4, 3, 5}, 2);
  const ThicknessReport open = check(box, 1);
  CHECK(open.verdict == ThicknessVerdict::NotJudged);
  CHECK(open.unjudged.openCount == 40);  // The bottom.
  CHECK(open.noValueCount == 8);
  CHECK(open.unjudged.invertedCount == 0);
  CHECK(std::isnan(open.min));  // The next wall is not searched.
  CHECK(check(box, 3.5).verdict == ThicknessVerdict::Failed);
  CHECK(check(shapes::cube(), 1).verdict == ThicknessVerdict::Passed);
  CHECK_FALSE(check(box, {}).verdict.has_value());
}

TEST_CASE("an inverted component is not judged; beside it a thin one fails") {
  const Mesh cube = shapes::cube(), thin = shapes::box({3, 3, 0.2});
  const ThicknessReport alone = check(shapes::inverted(cube), 0.1);
  CHECK(alone.verdict == ThicknessVerdict::NotJudged);
  CHECK(alone.unjudged.invertedCount == 12);
  CHECK(alone.unjudged.openCount == 0);
  CHECK(std::isnan(alone.min));
  const ThicknessReport beside = check(shapes::joined(cube, shapes::inverted(thin), {9, 0, 0}), 1);
  CHECK(beside.verdict == ThicknessVerdict::NotJudged);
  CHECK(beside.unjudged.invertedCount == 12);
  CHECK(beside.regions.empty());
  CHECK(check(shapes::joined(thin, shapes::inverted(cube), {9, 0, 0}), 1).verdict == ThicknessVerdict::Failed);
}

TEST_CASE("a mesh that the caller flips is not misoriented") {
  const Mesh thin = shapes::inverted(shapes::box({3, 3, 0.2})), thick = shapes::inverted(shapes::cube());
  for (const Orientation orientation : {Orientation::Flip, Orientation::Auto}) {
    const ThicknessReport failed = check(thin, 1, orientation), passed = check(thick, 1, orientation);
    CHECK(failed.unjudged.invertedCount == 0);
    CHECK(failed.verdict == ThicknessVerdict::Failed);
    CHECK(failed.min == doctest::Approx(0.2));
    CHECK(passed.verdict == ThicknessVerdict::Passed);
    CHECK(passed.unjudged.invertedCount == 0);
  }
  // One that was oriented outwards has no thickness then, as its inside is outside.
  const ThicknessReport outside = check(shapes::cube(), 1, Orientation::Flip);
  CHECK(outside.unjudged.invertedCount == 0);
  CHECK(outside.unjudged.openCount == 0);
  CHECK(outside.noValueCount == 12);
  CHECK(outside.verdict == ThicknessVerdict::NotJudged);
}

TEST_CASE("flipping does not judge a mesh that is open or wound against itself") {
  Mesh mixed = shapes::inverted(shapes::cube());
  std::swap(mixed.faces[7][0], mixed.faces[7][1]);
  const Mesh open = shapes::openBox({4, 3, 5}, 2);
  for (const Orientation orientation : {Orientation::Keep, Orientation::Flip}) {
    CAPTURE(static_cast<int>(orientation));
    for (const Mesh& mesh : {open, shapes::inverted(open)}) {
      CHECK(check(mesh, 1, orientation).unjudged.openCount == 40);
      CHECK(check(mesh, 1, orientation).verdict == ThicknessVerdict::NotJudged);
    }
    for (const Mesh& mesh : {mixed, shapes::inverted(mixed)}) {
      CHECK(check(mesh, 0.1, orientation).unjudged.invertedCount == 12);
      CHECK(check(mesh, 0.1, orientation).verdict == ThicknessVerdict::NotJudged);
    }
  }
}

TEST_CASE("the gap between two bodies is that of the flipped mesh") {
  const Mesh two = shapes::joined(shapes::box({3, 3, 1}), shapes::box({3, 3, 1}), {0, 0, 1.25});
  for (const double limit : {0.2, 0.3}) {
    const ThicknessReport gap = check(two, limit, Orientation::Flip);
    CHECK(gap.min == doctest::Approx(0.25).epsilon(0.01));
    CHECK(gap.verdict == (limit < 0.25 ? ThicknessVerdict::Passed : ThicknessVerdict::Failed));
  }
  CHECK(check(two, 0.3).verdict == ThicknessVerdict::Passed);
}

TEST_CASE("degenerate faces are counted and prevent no verdict, but alone they have none") {
  Mesh mesh = shapes::cube();
  mesh.faces.push_back({0, 0, 1});
  const ThicknessReport one = check(mesh, 1);
  CHECK(one.unjudged.degenerateCount == 1);
  CHECK(one.verdict == ThicknessVerdict::Passed);
  const Mesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}, {}};
  const ThicknessReport none = check(line, 1);
  CHECK(none.verdict == ThicknessVerdict::NotJudged);
  CHECK(none.unjudged.degenerateCount == 2);
  CHECK(std::isnan(none.min));
}

TEST_CASE("faces that cross each other are counted, and the union is judged") {
  const Mesh box = shapes::box({2, 2, 2}), crossing = shapes::joined(box, box, {1.1, 0.3, 0.2});
  const ThicknessReport report = check(crossing, 0.5);
  CHECK(report.unjudged.crossedCount > 0);
  CHECK(report.unjudged.crossedCount <= 24);
  CHECK(report.unjudged.insideCount > 0);
  CHECK(report.verdict == ThicknessVerdict::Passed);
  CHECK(check(crossing, {}).unjudged.crossedCount == report.unjudged.crossedCount);
  CHECK(check(crossing, 0.85).verdict == ThicknessVerdict::Passed);  // At the neck, they overlap by 0.9.
  Options strict = limitedTo(0.95);
  strict.thickness.countsEdges = true;  // The strips at the neck are too narrow for walls.
  CHECK(referenceSession().compute(crossing, strict).report.thickness->min == doctest::Approx(0.9));
  const ThicknessReport touching = check(shapes::joined(box, box, {2, 0, 0}), 1);
  CHECK(touching.unjudged.crossedCount == 0);
  CHECK(touching.unjudged.insideCount == 4);
  CHECK(touching.verdict == ThicknessVerdict::Passed);
  CHECK(touching.noValueCount == 4);
}

TEST_CASE("a wall of 0.999 of the limit passes, in coordinates of float32, at any place") {
  for (const double shift : {0.0, 0.1, 7.3, -20.7}) {
    CAPTURE(shift);
    const Mesh plate =
        inFloat32(shapes::scaledAndShifted(shapes::box({40, 30, 0.8}, 2), 1, {shift, -shift, shift / 3}));
    CHECK(check(plate, 0.8).verdict == ThicknessVerdict::Passed);
    CHECK(check(plate, 0.8).regions.empty());
    CHECK(check(plate, 0.8005).verdict == ThicknessVerdict::Passed);
    CHECK(check(plate, 0.8010).verdict == ThicknessVerdict::Failed);
  }
  for (const char* name : {"pocket", "stepped-plate"}) {
    const double wall = makeThicknessPart(name).leastThickness;
    CHECK(check(inFloat32(part(name)), wall).verdict == ThicknessVerdict::Passed);
    CHECK(check(inFloat32(part(name)), wall * 1.0005).verdict == ThicknessVerdict::Passed);
    CHECK(check(inFloat32(part(name)), wall * 1.0015).verdict == ThicknessVerdict::Failed);
  }
}

TEST_CASE("the report has the size of the bounding box") {
  const Mesh mesh = shapes::scaledAndShifted(shapes::box({4, 3, 0.5}, 2), 1, {100, -3, 0.25});
  const Vec3d size = referenceSession().compute(mesh, limitedTo(1)).report.size;
  CHECK(size.x == doctest::Approx(4));
  CHECK(size.y == doctest::Approx(3));
  CHECK(size.z == doctest::Approx(0.5));
}

TEST_CASE("session and scene give one verdict, and a region of faces that of the faces inside") {
  // The edge has 25 degrees, and the floor of the pocket is 0.7 thick.
  constexpr double kEdgeDegrees = 25;
  constexpr std::array<double, 4> kXs{0, 45, 55, 60}, kYs{0, 6, 14, 20};
  BlockSolid solid;
  solid.addLattice(
      {3, 3, 2},
      [&](uint32_t i, uint32_t j, uint32_t k) {
        return Vec3d{kXs[i], kYs[j],
                     k == 0 || i == 0 ? 0
                     : k == 1         ? 0.7
                                      : kXs[i] * std::tan(kEdgeDegrees * std::numbers::pi / 180)};
      },
      [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  const Mesh mesh = solid.surface({.longestEdge = 5});
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  Scene scene(referenceSession(), mesh);
  const Options options = limitedTo(0.8);
  const ThicknessReport whole = referenceSession().compute(mesh, options).report.thickness.value();
  CHECK(whole.verdict == ThicknessVerdict::Failed);
  CHECK(whole.min == doctest::Approx(0.7));
  REQUIRE(whole.regions.size() == 2);
  CHECK(whole.regions[0].kind == ThinKind::Wall);
  CHECK(whole.regions[1].kind == ThinKind::Edge);
  CHECK(whole.regions[1].angleDegrees == doctest::Approx(kEdgeDegrees));
  const auto checkRegion = [&](auto isInside) {
    std::vector<uint8_t> region(mesh.faces.size());
    for (size_t face = 0; face < region.size(); ++face) region[face] = isInside(geometry.barycentres[face]) ? 1 : 0;
    return scene.compute(options, region).report.thickness.value();
  };
  const auto isSameRegion = [](const ThinRegion& a, const ThinRegion& b) {
    return a.min == b.min && a.area == b.area && a.minFace == b.minFace && a.faceCount == b.faceCount &&
           a.kind == b.kind;
  };
  const ThicknessReport all = checkRegion([](const Vec3d&) { return true; });
  const ThicknessReport pocket = checkRegion([](const Vec3d& p) { return p.x > 35; });
  const ThicknessReport blade = checkRegion([](const Vec3d& p) { return p.x < 35; });
  const ThicknessReport middle = checkRegion([](const Vec3d& p) { return 15 < p.x && p.x < 35; });
  CHECK(all.verdict == whole.verdict);
  REQUIRE(all.regions.size() == 2);
  for (size_t i = 0; i < 2; ++i) CHECK(isSameRegion(all.regions[i], whole.regions[i]));
  // The wall of the pocket comes first. The edge has a region of its own.
  CHECK(pocket.verdict == ThicknessVerdict::Failed);
  CHECK(pocket.min == whole.min);
  REQUIRE(pocket.regions.size() == 1);
  CHECK(isSameRegion(pocket.regions[0], whole.regions[0]));
  CHECK(blade.verdict == ThicknessVerdict::Passed);
  REQUIRE(blade.regions.size() == 1);
  CHECK(isSameRegion(blade.regions[0], whole.regions[1]));
  CHECK(middle.verdict == ThicknessVerdict::Passed);
  CHECK(middle.regions.empty());
  CHECK_FALSE(middle.min < 0.8);
}
