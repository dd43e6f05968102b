#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "asdf_vk/scene.h"
#include "generate/block_solid.h"
#include "generate/thickness_parts.h"
#include "mesh/face_geometry.h"
#include "random_solids/assembly.h"
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
  CHECK(open.min == doctest::Approx(3));
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
  CHECK(beside.min == doctest::Approx(2).epsilon(1e-3));
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

TEST_CASE("the gap between two bodies is that of the flipped mesh") {
  const Mesh two = shapes::joined(shapes::box({3, 3, 1}), shapes::box({3, 3, 1}), {0, 0, 1.25});
  for (const double limit : {0.2, 0.3}) {
    const ThicknessReport gap = check(two, limit, Orientation::Flip);
    CHECK(gap.min == doctest::Approx(0.25));
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

TEST_CASE("faces that cross each other are counted with a limit, and judged") {
  const Mesh box = shapes::box({2, 2, 2}), crossing = shapes::joined(box, box, {1.1, 0.3, 0.2});
  const ThicknessReport report = check(crossing, 0.5);
  CHECK(report.unjudged.crossedCount > 0);
  CHECK(report.unjudged.crossedCount <= 24);
  CHECK(report.verdict == ThicknessVerdict::Passed);
  CHECK(check(crossing, {}).unjudged.crossedCount == 0);
  CHECK(check(crossing, 1.9).verdict == ThicknessVerdict::Passed);  // Each alone, though they overlap by 0.9.
  CHECK(check(crossing, 2.1).verdict == ThicknessVerdict::Failed);
  const ThicknessReport touching = check(shapes::joined(box, box, {2, 0, 0}), 1);
  CHECK(touching.unjudged.crossedCount == 0);
  CHECK(touching.verdict == ThicknessVerdict::Passed);
}

TEST_CASE("a wall as thick as the limit passes, in coordinates of float32, at any place") {
  for (const double shift : {0.0, 0.1, 7.3, -20.7}) {
    CAPTURE(shift);
    const Mesh plate =
        inFloat32(shapes::scaledAndShifted(shapes::box({40, 30, 0.8}, 2), 1, {shift, -shift, shift / 3}));
    CHECK(check(plate, 0.8).verdict == ThicknessVerdict::Passed);
    CHECK(check(plate, 0.8).regions.empty());
    CHECK(check(plate, 0.8001).verdict == ThicknessVerdict::Failed);
    CHECK(check(plate, 0.7999).verdict == ThicknessVerdict::Passed);
  }
  for (const char* name : {"pocket", "stepped-plate"}) {
    const double wall = makeThicknessPart(name).leastThickness;
    CHECK(check(inFloat32(part(name)), wall).verdict == ThicknessVerdict::Passed);
    CHECK(check(inFloat32(part(name)), wall * 1.0001).verdict == ThicknessVerdict::Failed);
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
  const Mesh mesh = part("blade", 5);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  Scene scene(referenceSession(), mesh);
  Options options = limitedTo(0.8);
  options.thickness.allowsSharpEdges = true;
  const ThicknessReport whole = referenceSession().compute(mesh, options).report.thickness.value();
  CHECK(whole.verdict == ThicknessVerdict::Failed);
  CHECK(whole.min == doctest::Approx(0.7));
  REQUIRE(whole.regions.size() == 2);
  const auto checkRegion = [&](auto isInside) {
    std::vector<uint8_t> region(mesh.faces.size());
    for (size_t face = 0; face < region.size(); ++face) region[face] = isInside(geometry.barycentres[face]) ? 1 : 0;
    return scene.compute(options, region).report.thickness.value();
  };
  const auto isSameRegion = [](const ThinRegion& a, const ThinRegion& b) {
    return a.min == b.min && a.area == b.area && a.minFace == b.minFace && a.faceCount == b.faceCount &&
           a.isSharp == b.isSharp;
  };
  const ThicknessReport all = checkRegion([](const Vec3d&) { return true; });
  const ThicknessReport pocket = checkRegion([](const Vec3d& p) { return p.x > 35; });
  const ThicknessReport blade = checkRegion([](const Vec3d& p) { return p.x < 35; });
  const ThicknessReport middle = checkRegion([](const Vec3d& p) { return 15 < p.x && p.x < 35; });
  CHECK(all.verdict == whole.verdict);
  REQUIRE(all.regions.size() == 2);
  for (size_t i = 0; i < 2; ++i) CHECK(isSameRegion(all.regions[i], whole.regions[i]));
  // The wall of the pocket comes first. The sharp edge has a region of its own.
  CHECK(pocket.verdict == ThicknessVerdict::Failed);
  CHECK(pocket.min == whole.min);
  CHECK(pocket.sharpEdges.empty());
  REQUIRE(pocket.regions.size() == 1);
  CHECK(isSameRegion(pocket.regions[0], whole.regions[0]));
  CHECK(blade.verdict == ThicknessVerdict::Passed);
  REQUIRE(blade.regions.size() == 1);
  CHECK(blade.regions[0].isSharp);
  CHECK(blade.sharpEdges.size() == 1);
  CHECK(middle.verdict == ThicknessVerdict::Passed);
  CHECK(middle.regions.empty());
  CHECK(middle.min >= 0.8);
}

TEST_CASE("parts that touch or cross have the thickness of the same parts apart" * doctest::test_suite("slow")) {
  struct Case {
    uint64_t seed;
    bool crosses = false;
  };
  for (const Case& each : {Case{1}, Case{2}, Case{3}, Case{4}, Case{5}, Case{6}, Case{7}, Case{53}, Case{1, true},
                           Case{22, true}, Case{23, true}}) {
    CAPTURE(each.seed);
    CAPTURE(each.crosses);
    std::vector<std::vector<double>> values;
    for (const std::optional<double> apart : {std::optional<double>(), std::optional(1.0)}) {
      const Mesh mesh = makeAssembly({each.seed, each.crosses, apart}).mesh;
      values.push_back(*referenceSession().compute(mesh, limitedTo(std::nullopt)).field("least_thickness")->reals());
    }
    REQUIRE(values[0].size() == values[1].size());
    for (size_t i = 0; i < values[0].size(); ++i) {
      CAPTURE(i);
      CHECK(values[0][i] == doctest::Approx(values[1][i]).epsilon(1e-4));
    }
  }
}

TEST_CASE("a body has the thickness that it has apart where a part around its cavity crosses it") {
  const std::vector<double> xs{-3, -2.5, 2.5, 3}, zs{-3, -2.5, 8};
  BlockSolid cup;
  cup.addLattice(
      {3, 3, 2},
      [&](uint32_t i, uint32_t j, uint32_t k) {
        return Vec3d{xs[i], xs[j], zs[k]};
      },
      [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  const Mesh hollow = shapes::joined(shapes::box({10, 10, 10}), shapes::inverted(shapes::box({4, 4, 4})));
  std::vector<std::vector<double>> values;
  for (const double distance : {0.0, 40.0}) {
    const Mesh mesh = shapes::joined(hollow, cup.surface(), {distance, 0, 0});
    const Result result = referenceSession().compute(mesh, limitedTo(0.4));
    CHECK(result.report.thickness->verdict == ThicknessVerdict::Passed);
    CHECK(result.report.thickness->unjudged.invertedCount == 0);
    values.push_back(*result.field("least_thickness")->reals());
  }
  REQUIRE(values[0].size() == values[1].size());
  for (size_t i = 0; i < values[0].size(); ++i) {
    CAPTURE(i);
    CHECK(values[0][i] == doctest::Approx(values[1][i]).epsilon(1e-6));
  }
}
