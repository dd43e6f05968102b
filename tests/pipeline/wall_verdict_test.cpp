#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "asdf_vk/scene.h"
#include "core/random.h"
#include "generate/block_solid.h"
#include "generate/thickness_parts.h"
#include "mesh/face_geometry.h"
#include "support/shapes.h"
#include "support/shared_session.h"

// The verdict of the wall check, and the faces that it does not judge.

using namespace asdfvk;
using test::referenceSession;

namespace {

Options limitedTo(std::optional<double> limit, Orientation orientation = Orientation::Keep) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  options.orientation = orientation;
  return options;
}

ThicknessReport check(const Mesh& mesh, std::optional<double> limit, Orientation orientation = Orientation::Keep) {
  return referenceSession().compute(mesh, limitedTo(limit, orientation)).report.thickness.value();
}

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

namespace {

/// Every face with vertices of its own.
Mesh split(const Mesh& mesh) {
  Mesh result;
  for (const Face& face : mesh.faces) {
    const auto first = static_cast<uint32_t>(result.vertices.size());
    for (const uint32_t vertex : face) result.vertices.push_back(mesh.vertices[vertex]);
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

/// One vertex per position, as readers of STL files make it.
Mesh welded(Mesh mesh) {
  for (Face& face : mesh.faces)
    for (uint32_t& vertex : face)
      vertex = static_cast<uint32_t>(std::find(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices[vertex]) -
                                     mesh.vertices.begin());
  return mesh;
}

}  // namespace

TEST_CASE("a closed surface is judged with vertices that are split or shared between bodies") {
  const Mesh box = shapes::box({2, 2, 2}), plate = shapes::box({2, 2, 0.25});
  struct Case {
    const char* name;
    Mesh mesh;
    double least;
  };
  for (const Case& each : {Case{"one", box, 2}, Case{"side by side", shapes::joined(plate, plate, {2, 0, 0}), 0.25},
                           Case{"at an edge", shapes::joined(box, plate, {2, 0, 1.125}), 0.25}}) {
    CAPTURE(each.name);
    for (const Mesh& mesh : {each.mesh, split(each.mesh), welded(each.mesh)}) {
      const ThicknessReport passed = check(mesh, 0.9 * each.least), failed = check(mesh, 1.1 * each.least);
      CHECK(passed.verdict == ThicknessVerdict::Passed);
      CHECK(passed.unjudged.reasons.empty());
      CHECK(failed.verdict == ThicknessVerdict::Failed);
      CHECK(failed.min == doctest::Approx(each.least).epsilon(1e-3));
    }
  }
}

TEST_CASE("the report counts welded vertices, and values do not depend on them") {
  const Mesh ball = shapes::icosphere(2), soup = split(ball);
  const Result whole = referenceSession().compute(ball, {}), apart = referenceSession().compute(soup, {});
  CHECK(whole.report.defects.weldedVertexCount == 0);
  CHECK(apart.report.defects.weldedVertexCount == soup.vertices.size() - ball.vertices.size());
  CHECK(apart.report.defects.unreferencedVertexCount == 0);
  CHECK(apart.report.defects.boundaryEdgeCount == 0);
  CHECK(apart.report.componentCount == 1);
  CHECK(apart.report.faceCount == ball.faces.size());
  CHECK(apart.report.vertexCount == soup.vertices.size());
  CHECK(apart.report.seedCount == whole.report.seedCount);
}

TEST_CASE("each reason has its cause, its first place and whether --orient auto helps") {
  const auto reasonOf = [](const Mesh& mesh) {
    const ThicknessReport report = check(mesh, 0.1);
    CHECK(report.verdict == ThicknessVerdict::NotJudged);
    REQUIRE(report.unjudged.reasons.size() == 1);
    return report.unjudged.reasons[0];
  };
  const UnjudgedReason open = reasonOf(shapes::openBox({4, 3, 5}, 1));
  CHECK(open.cause == UnjudgedCause::Border);
  CHECK(open.edgeCount == 4);
  CHECK(open.place.z == doctest::Approx(2.5));
  CHECK_FALSE(open.isRepairable);
  Mesh imprinted = shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0});
  std::erase_if(imprinted.faces, [&](const Face& face) {
    return std::all_of(face.begin(), face.end(), [&](uint32_t v) { return v >= 8 && imprinted.vertices[v].x == 1; });
  });
  const UnjudgedReason branching = reasonOf(welded(imprinted));
  CHECK(branching.cause == UnjudgedCause::Branching);
  CHECK(branching.edgeCount == 4);
  CHECK(branching.place.x == 1);
  Mesh mixed = shapes::cube();
  std::swap(mixed.faces[7][0], mixed.faces[7][1]);
  const UnjudgedReason wound = reasonOf(mixed);
  CHECK(wound.cause == UnjudgedCause::WoundAgainst);
  CHECK(wound.edgeCount == 3);
  CHECK(wound.isRepairable);
  CHECK(check(mixed, 0.1, Orientation::Auto).verdict == ThicknessVerdict::Passed);
  const Result turned = referenceSession().compute(mixed, limitedTo(0.1, Orientation::Auto));
  CHECK(turned.report.reversedFaceCount == 1);
  CHECK(turned.reversedFaces == std::vector<uint64_t>{7});
  const Result both = referenceSession().compute(shapes::inverted(mixed), limitedTo(0.1, Orientation::Auto));
  CHECK(both.report.thickness->verdict == ThicknessVerdict::Passed);
  CHECK(both.reversedFaces == std::vector<uint64_t>{0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11});
  const UnjudgedReason inwards = reasonOf(shapes::inverted(shapes::cube()));
  CHECK(inwards.cause == UnjudgedCause::Inverted);
  CHECK(inwards.face == 0);
  CHECK(inwards.isRepairable);
}

TEST_CASE("a label on a plate, or sunk into it, has the thickness of both together") {
  const Mesh plate = shapes::box({30, 20, 3}, 2), label = shapes::box({10, 5, 0.6});
  for (const double depth : {0.0, 0.3, 0.6}) {
    CAPTURE(depth);
    const Mesh mesh = shapes::joined(plate, label, {2, 3, 1.5 + 0.3 - depth});
    for (const Mesh& each : {mesh, split(mesh), welded(mesh)}) {
      CHECK(check(each, 2.9).verdict == ThicknessVerdict::Passed);
      CHECK(check(each, 3.1).min == doctest::Approx(3));
    }
    const Result result = referenceSession().compute(mesh, limitedTo(std::nullopt));
    const std::vector<double>& least = *findField(result.fields, "least_thickness")->reals();
    const FaceGeometry geometry = computeFaceGeometry(mesh);
    for (size_t face = plate.faces.size(); face < mesh.faces.size(); ++face) {
      if (geometry.normals[face].z > 0.5) CHECK(least[face] == doctest::Approx(3.6 - depth));
      if (geometry.normals[face].z < -0.5) CHECK(std::isnan(least[face]));  // Inside of the plate.
    }
  }
}

TEST_CASE("walls without a thickness fail, and surfaces without material are not judged") {
  const Mesh box = shapes::box({4, 4, 2});
  const Mesh sheet{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, {}};
  const ThicknessReport beside = check(shapes::joined(box, sheet, {10, 0, 0}), 0.5);
  CHECK(beside.verdict == ThicknessVerdict::Failed);
  CHECK(beside.min == 0);
  CHECK(beside.minFace.value() >= 12);
  CHECK(beside.minPlace.value().x > 9);
  for (const Mesh& mesh : {shapes::box({4, 4, 1}), shapes::icosphere(2, 5)}) {
    const ThicknessReport doubled = check(shapes::joined(mesh, shapes::inverted(mesh)), 0.5);
    CHECK(doubled.verdict == ThicknessVerdict::NotJudged);
    REQUIRE(doubled.unjudged.reasons.size() == 1);
    CHECK(doubled.unjudged.reasons[0].cause == UnjudgedCause::DoubleSided);
    CHECK(doubled.unjudged.reasons[0].faceCount == 2 * mesh.faces.size());
  }
  // A shell in a shell, both outwards, and copies: the union.
  const Mesh ball = shapes::icosphere(2, 5);
  const ThicknessReport nested = check(shapes::joined(ball, shapes::icosphere(2, 3)), 0.5);
  CHECK(nested.verdict == ThicknessVerdict::Passed);
  CHECK(nested.unjudged.insideCount == ball.faces.size());
  CHECK(nested.min == check(ball, 0.5).min);
  CHECK(check(shapes::joined(ball, ball), 0.5).min == check(ball, 0.5).min);
}

TEST_CASE("half of a bow tie is inverted") {
  const Mesh bow{{{0, 0, 0}, {9, 4, 0}, {9, 0, 0}, {0, 4, 0}, {0, 0, 4}, {9, 4, 4}, {9, 0, 4}, {0, 4, 4}},
                 {{0, 2, 1},
                  {0, 3, 2},
                  {4, 5, 6},
                  {4, 6, 7},
                  {0, 1, 5},
                  {0, 5, 4},
                  {1, 2, 6},
                  {1, 6, 5},
                  {2, 3, 7},
                  {2, 7, 6},
                  {3, 0, 4},
                  {3, 4, 7}},
                 {}};
  const ThicknessReport report = check(bow, 1e-3);
  REQUIRE(report.unjudged.reasons.size() == 1);
  CHECK(report.unjudged.reasons[0].cause == UnjudgedCause::Inverted);
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
  CHECK(check(crossing, 0.95).min == doctest::Approx(0.9));
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

TEST_CASE("boxes that touch or overlap have the least thickness of their union" * doctest::test_suite("slow")) {
  constexpr uint32_t kCount = 3;
  int differingCount = 0;  // There are 240 verdicts.
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::array<std::array<double, kCount + 1>, 3> planes{};
    for (auto& axis : planes)
      for (uint32_t i = 0; i < kCount; ++i) axis[i + 1] = axis[i] + 0.3 + random.real();
    std::array<bool, kCount * kCount * kCount> isSolid{};
    for (bool& cell : isSolid) cell = random.real() < 0.6;
    const auto at = [&](uint32_t i, uint32_t j, uint32_t k) { return isSolid[(i * kCount + j) * kCount + k]; };
    BlockSolid block;
    block.addLattice(
        {kCount, kCount, kCount},
        [&](uint32_t i, uint32_t j, uint32_t k) {
          return Vec3d{planes[0][i], planes[1][j], planes[2][k]};
        },
        at);
    Mesh boxes;
    const auto addBox = [&](const std::array<uint32_t, 3>& low, const std::array<uint32_t, 3>& high) {
      Vec3d size, middle;
      for (size_t axis = 0; axis < 3; ++axis) {
        size[axis] = planes[axis][high[axis]] - planes[axis][low[axis]];
        middle[axis] = 0.5 * (planes[axis][high[axis]] + planes[axis][low[axis]]);
      }
      boxes = shapes::joined(std::move(boxes), shapes::box(size), middle);
    };
    for (uint32_t i = 0; i < kCount; ++i)
      for (uint32_t j = 0; j < kCount; ++j)
        for (uint32_t k = 0; k < kCount; ++k) {
          if (!at(i, j, k)) continue;
          addBox({i, j, k}, {i + 1, j + 1, k + 1});
          if (k + 1 < kCount && at(i, j, k + 1)) addBox({i, j, k}, {i + 1, j + 1, k + 2});  // Overlaps two others.
        }
    if (boxes.faces.empty()) continue;
    const auto turned = [&](Mesh mesh) {
      if (seed % 2 == 0) return mesh;
      for (Vec3d& v : mesh.vertices)
        v = {0.6 * v.x - 0.8 * v.y, 0.48 * v.x + 0.36 * v.y - 0.8 * v.z, 0.64 * v.x + 0.48 * v.y + 0.6 * v.z};
      return mesh;
    };
    const Mesh whole = turned(block.surface()), parts = turned(boxes);
    for (const double limit : {0.25, 0.5, 0.75, 1.0}) {
      const ThicknessReport expected = check(whole, limit), united = check(parts, limit);
      const bool isFailure = expected.verdict == ThicknessVerdict::Failed;
      if (united.verdict == expected.verdict &&
          (!isFailure || std::abs(united.min - expected.min) < 0.02 * expected.min))
        continue;
      MESSAGE("seed ", seed, ", limit ", limit, ": ", united.min, " instead of ", expected.min);
      ++differingCount;
    }
  }
  // Pieces of crossed faces have edges in common only in part. There, the surface around a point may end early.
  CHECK(differingCount <= 4);
}

TEST_CASE("a part around a cavity that crosses it is judged") {
  const std::vector<double> xs{-3, -2.5, 2.5, 3}, zs{-3, -2.5, 8};
  BlockSolid cup;
  cup.addLattice(
      {3, 3, 2},
      [&](uint32_t i, uint32_t j, uint32_t k) {
        return Vec3d{xs[i], xs[j], zs[k]};
      },
      [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  const Mesh hollow = shapes::joined(shapes::box({10, 10, 10}), shapes::inverted(shapes::box({4, 4, 4})));
  for (const double distance : {0.0, 40.0}) {
    const ThicknessReport report = check(shapes::joined(hollow, cup.surface(), {distance, 0, 0}), 0.4);
    CHECK(report.verdict == ThicknessVerdict::Passed);
    CHECK(report.unjudged.invertedCount == 0);
    CHECK((report.unjudged.insideCount > 0) == (distance == 0));
    CHECK(report.min == doctest::Approx(0.5));
  }
}
