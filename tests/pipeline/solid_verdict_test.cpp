#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/random.h"
#include "generate/block_solid.h"
#include "generate/solids.h"
#include "mesh/face_geometry.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "wall_check.h"

// The solid that the wall check judges: closed surfaces, the union of bodies, sheets.

using namespace asdfvk;
using test::check;
using test::limitedTo;
using test::referenceSession;
using test::reportHas;

namespace {

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
    for (const Mesh& mesh : {each.mesh, solids::separated(each.mesh), welded(each.mesh)}) {
      const ThicknessReport passed = check(mesh, 0.9 * each.least), failed = check(mesh, 1.1 * each.least);
      CHECK(passed.verdict == ThicknessVerdict::Passed);
      CHECK(passed.unjudged.reasons.empty());
      CHECK(failed.verdict == ThicknessVerdict::Failed);
      CHECK(failed.min == doctest::Approx(each.least).epsilon(1e-3));
    }
  }
}

TEST_CASE("the report counts welded vertices, and values do not depend on them") {
  const Mesh ball = shapes::icosphere(2), soup = solids::separated(ball);
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
    for (const Mesh& each : {mesh, solids::separated(mesh), welded(mesh)}) {
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

TEST_CASE("a sheet that lies on a solid or in it is no wall") {
  const Mesh box = shapes::box({2, 2, 2});
  const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}, {}};
  for (const double height : {-1.0, 0.0, 1.0}) {  // The box has its centre in the origin.
    CAPTURE(height);
    const Mesh mesh = welded(shapes::joined(box, sheet, {-0.5, -0.25, height}));
    CHECK(check(mesh, 0.5).verdict == ThicknessVerdict::Passed);
  }
  Mesh doubled = box;  // A copy of a face, and its reverse.
  const Face first = box.faces[0];
  doubled.faces.push_back(first);
  doubled.faces.push_back({first[0], first[2], first[1]});
  CHECK(check(doubled, 0.5).verdict == ThicknessVerdict::Passed);
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

TEST_CASE("boxes that touch or overlap have the least thickness of their union" * doctest::test_suite("slow")) {
  constexpr uint32_t kCount = 3;
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
      CHECK(united.verdict == expected.verdict);
      const bool isFailure = expected.verdict == ThicknessVerdict::Failed;
      if (isFailure) CHECK(united.min == doctest::Approx(expected.min).epsilon(0.05));
    }
  }
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

TEST_CASE("a mesh with negative volumes is not judged, whether thin walls are found or not") {
  Mesh plate = shapes::box({2, 2, 0.25});
  plate.negativeVolumeCount = 2;
  for (const double limit : {0.1, 0.5}) {
    const Result result = referenceSession().compute(plate, limitedTo(limit));
    const ThicknessReport& thickness = *result.report.thickness;
    CHECK(thickness.verdict == ThicknessVerdict::NotJudged);
    REQUIRE(thickness.unjudged.reasons.size() == 1);
    CHECK(thickness.unjudged.reasons[0].cause == UnjudgedCause::NegativeVolumes);
    CHECK(thickness.unjudged.reasons[0].amount == 2);
    CHECK(reportHas(result.report, WarningCode::NegativeVolumes));
  }
}

TEST_CASE("float32 coordinates far from the origin are not judged if their steps exceed a quarter of the limit") {
  // The steps of float32 are 0.5 from 2^22 on, and 1 / 1024 from 2^13 on.
  struct Case {
    double offset, limit;
    ThicknessVerdict verdict;
    bool warns;
  };
  for (const Case& each :
       {Case{5e6, 1, ThicknessVerdict::NotJudged, true}, Case{5e6, 3, ThicknessVerdict::Passed, true},
        Case{5e6, 6, ThicknessVerdict::Failed, true}, Case{10000, 1, ThicknessVerdict::Passed, false},
        Case{10000, 0.003, ThicknessVerdict::NotJudged, false}, Case{0, 0.003, ThicknessVerdict::Passed, false}}) {
    CAPTURE(each.offset);
    CAPTURE(each.limit);
    Mesh plate = shapes::box({200, 200, 4});
    for (Vec3d& p : plate.vertices) p.x += each.offset;
    const Result result = referenceSession().compute(plate, limitedTo(each.limit));
    CHECK(result.report.thickness->verdict == each.verdict);
    CHECK(reportHas(result.report, WarningCode::CoarseCoordinates) == each.warns);
    plate.vertices[0].y += 1e-9;  // This coordinate is a double.
    CHECK(!reportHas(referenceSession().compute(plate, limitedTo(each.limit)).report, WarningCode::CoarseCoordinates));
  }
}
