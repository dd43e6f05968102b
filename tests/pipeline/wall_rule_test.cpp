#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "generate/block_solid.h"
#include "generate/extrusion.h"
#include "generate/thickness_parts.h"
#include "mesh/face_geometry.h"
#include "support/shapes.h"
#include "support/shared_session.h"

// Walls, details and edges (docs/thickness.md): shapes on both sides of each threshold of the rule. Lengths of outlines
// are in units of the limit.

using namespace asdfvk;
using solids::Outline;

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180, kDepth = 6;

ThicknessReport judge(const Mesh& mesh, double limit) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  return test::referenceSession().compute(mesh, options).report.thickness.value();
}

size_t countOf(const ThicknessReport& report, ThinKind kind) {
  return static_cast<size_t>(std::count_if(report.regions.begin(), report.regions.end(),
                                           [&](const ThinRegion& region) { return region.kind == kind; }));
}

/// A plate with a rib in its middle, 0.5 thick.
Outline ribbed(double height) {
  return {{-8, -4}, {8, -4}, {8, 0}, {0.25, 0}, {0.25, height}, {-0.25, height}, {-0.25, 0}, {-8, 0}};
}

/// A wedge of 10 length that ends in an edge, or in a side of thickness `cut`.
Outline wedge(double degrees, double cut = 0) {
  const double slope = std::tan(degrees / 2 * kRadiansPerDegree), height = 10 * slope;
  if (cut == 0) return {{0, 0}, {10, -height}, {10, height}};
  const double begin = cut / 2 / slope;
  return {{begin, -cut / 2}, {10, -height}, {10, height}, {begin, cut / 2}};
}

/// A body on whose flat bottom a fillet runs out tangentially.
Outline runOut(double radius) {
  Outline outline = solids::arc(0, radius, radius, -90, -90 + 64.16, 24);
  const double x = outline.back().first;
  outline.insert(outline.end(), {{x, 3 * radius}, {8 + radius, 3 * radius}, {8 + radius, 0}});
  return outline;
}

/// A plate with round notches of radius 2 in two opposite sides, and a ligament between them.
Outline notched(double ligament) {
  Outline outline = solids::arc(0, -2 - ligament / 2, 2, 180, 0, 24);
  const double y = 2 + ligament / 2;
  const Outline upper = solids::arc(0, y, 2, 0, -180, 24);
  outline.insert(outline.end(), {{10, -y}, {10, y}});
  outline.insert(outline.end(), upper.begin(), upper.end());
  outline.insert(outline.end(), {{-10, y}, {-10, -y}});
  return outline;
}

struct Case {
  std::string name;
  Outline outline;
  bool isWall;
};

/// Within 5 % of the thresholds of docs/thickness.md.
std::vector<Case> thresholdCases() {
  return {{"rib .64 high", ribbed(0.64), false},
          {"rib .7 high", ribbed(0.7), true},
          {"wedge of 17.8 degrees", wedge(17.8), false},
          {"wedge of 16.2 degrees", wedge(16.2), true},
          {"cut wedge of 17.8 degrees", wedge(17.8, 0.125), false},
          {"cut wedge of 16.2 degrees", wedge(16.2, 0.125), true},
          {"run-out of radius 5", runOut(5), false},
          {"run-out of radius 18.6", runOut(18.6), false},
          {"run-out of radius 20.4", runOut(20.4), true},
          {"ligament .96", notched(0.96), false},
          {"ligament .88", notched(0.88), true}};
}

/// The faces whose normals are along y are refined, so that their edges lie on whole edges of the other faces.
Mesh withTJunctions(const Mesh& coarse) {
  const Mesh fine = solids::refined(coarse, 1.5);
  Mesh mixed;
  for (const bool isAlongY : {false, true}) {
    const Mesh& mesh = isAlongY ? fine : coarse;
    const FaceGeometry geometry = computeFaceGeometry(mesh);
    const auto first = static_cast<uint32_t>(mixed.vertices.size());
    mixed.vertices.insert(mixed.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (size_t f = 0; f < mesh.faces.size(); ++f)
      if (const auto& [a, b, c] = mesh.faces[f]; (std::abs(geometry.normals[f].y) > 0.5) == isAlongY)
        mixed.faces.push_back({first + a, first + b, first + c});
  }
  return mixed;
}

Mesh scaled(const Mesh& mesh, double factor) { return shapes::scaledAndShifted(mesh, factor); }

struct Pocket {
  double floor, x, y;  // Thickness of the floor, and its middle.
};

/// A plate 3 thick with up to eight pockets of 4 x 4 in two rows.
struct PocketPlate {
  BlockSolid solid;
  std::vector<Pocket> pockets;

  explicit PocketPlate(uint32_t count) {
    constexpr std::array kFloors{0.4, 0.65, 0.5, 0.55, 0.45, 0.6, 0.42, 0.58};
    for (uint32_t i = 0; i < count; ++i) pockets.push_back({kFloors[i], 5 + 7.0 * (i / 2), 5 + 7.0 * (i % 2)});
    std::vector<double> heights(kFloors.begin(), kFloors.begin() + count);
    heights.insert(heights.end(), {0, 3});
    std::sort(heights.begin(), heights.end());
    std::vector<DraftedPlane> xs{{0}}, ys{{0}, {3}, {7}, {10}, {14}, {17}};
    for (uint32_t i = 0; i < 4; ++i) xs.insert(xs.end(), {{3 + 7.0 * i}, {7 + 7.0 * i}});
    xs.push_back({31});
    addDraftedLattice(solid, xs, ys, heights, [&](uint32_t i, uint32_t j, uint32_t k) {
      const uint32_t pocket = (i - 1) / 2 * 2 + (j - 1) / 2;
      return i % 2 == 0 || j % 2 == 0 || pocket >= count || heights[k] < kFloors[pocket];
    });
  }
};

}  // namespace

TEST_CASE("shapes on both sides of each threshold, in two triangulations, turned, and in two units" *
          doctest::test_suite("slow")) {
  for (const Case& each : thresholdCases()) {
    CAPTURE(each.name);
    const Mesh coarse = solids::extruded(each.outline, kDepth);
    const std::array meshes{coarse, solids::turned(coarse, 0.5, 1.1), solids::refined(coarse, 1.5)};
    for (size_t i = 0; i < meshes.size(); ++i)
      for (const double limit : {0.8, 25.4 * 0.8}) {
        CAPTURE(i);
        CAPTURE(limit);
        const ThicknessReport report = judge(scaled(meshes[i], limit), limit);
        CHECK(report.verdict == (each.isWall ? ThicknessVerdict::Failed : ThicknessVerdict::Passed));
        CHECK((countOf(report, ThinKind::Wall) > 0) == each.isWall);
        CHECK_FALSE(report.regions.empty());
        if (each.isWall) CHECK(report.min < limit);
        if (!each.isWall) CHECK_FALSE(report.min < 0.999 * limit);
      }
  }
}

TEST_CASE("n pockets are n walls with their own thickness and place") {
  constexpr double kLimit = 0.8;
  for (uint32_t count = 1; count <= 8; ++count) {
    CAPTURE(count);
    PocketPlate plate(count);
    std::sort(plate.pockets.begin(), plate.pockets.end(),
              [](const Pocket& a, const Pocket& b) { return a.floor < b.floor; });
    const Mesh coarse = plate.solid.surface();
    for (const Mesh& mesh :
         {coarse, plate.solid.surface({.longestEdge = 3, .diagonalSeed = count}), scaled(coarse, 25.4)}) {
      const double unit = mesh.vertices.size() == coarse.vertices.size() && mesh.vertices != coarse.vertices ? 25.4 : 1;
      CAPTURE(unit);
      CAPTURE(mesh.faces.size());
      const ThicknessReport report = judge(mesh, unit * kLimit);
      CHECK(report.verdict == ThicknessVerdict::Failed);
      REQUIRE(report.regions.size() == count);
      CHECK(report.min == report.regions[0].min);
      for (uint32_t i = 0; i < count; ++i) {
        const ThinRegion& region = report.regions[i];
        const Pocket& pocket = plate.pockets[i];
        CHECK(region.kind == ThinKind::Wall);
        CHECK(region.min == doctest::Approx(unit * pocket.floor).epsilon(1e-6));
        CHECK(length(region.place - region.opposite) == doctest::Approx(region.min).epsilon(1e-6));
        for (const Vec3d& place : {region.place, region.opposite})
          CHECK(std::max(std::abs(place.x / unit - pocket.x), std::abs(place.y / unit - pocket.y)) <= 2.01);
      }
    }
    const ThicknessReport turned = judge(solids::turned(coarse, 0.5, 1.1), kLimit);
    CHECK(turned.regions.size() == count);
    CHECK(turned.min == doctest::Approx(plate.pockets[0].floor).epsilon(1e-6));
  }
}

TEST_CASE("a rib lower than 2/3 of the limit is a detail, and a wall at a smaller limit") {
  const Mesh coarse = solids::extruded(ribbed(0.6), kDepth);
  for (const Mesh& mesh : {coarse, withTJunctions(coarse)}) {
    const ThicknessReport low = judge(mesh, 1);
    CHECK(low.verdict == ThicknessVerdict::Passed);
    CHECK(countOf(low, ThinKind::Detail) == 1);
    const ThicknessReport high = judge(mesh, 0.6);
    CHECK(high.verdict == ThicknessVerdict::Failed);
    CHECK(high.min == doctest::Approx(0.5).epsilon(1e-6));
  }
}

TEST_CASE("a limit that finds a wall or a detail finds one at each greater limit" * doctest::test_suite("slow")) {
  for (const Case& each : thresholdCases()) {
    if (each.isWall) continue;  // The shapes on the other sides of the thresholds differ little.
    // The search for details looks at a limited number of points. It may miss the detail of a shape that tapers.
    if (each.name == "cut wedge of 17.8 degrees" || each.name.starts_with("run-out")) continue;
    CAPTURE(each.name);
    const Mesh mesh = solids::extruded(each.outline, kDepth);
    bool isFound = false;
    for (int i = 0; i < 20; ++i) {
      const double limit = 0.3 * std::pow(1.1, i);
      CAPTURE(limit);
      const ThicknessReport report = judge(mesh, limit);
      const bool finds = countOf(report, ThinKind::Wall) + countOf(report, ThinKind::Detail) > 0;
      CHECK((finds || !isFound));
      isFound = isFound || finds;
    }
  }
}
