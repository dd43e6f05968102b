#include "trace/greatest_section.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "generate/thickness_parts.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "trace/nearest_point.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

/// The greatest section of a mesh that is one solid, in the unit of the mesh. Checks that the ball is inside, and that
/// the bound is close.
double sectionOf(const TracedMesh& traced) {
  const std::vector<uint32_t> solidOf(traced.mesh.faceCount());
  const std::vector<uint8_t> isWanted{1};
  const std::vector<GreatestSection> sections =
      findGreatestSections(traced.scene(), solidOf, isWanted, SectionSearch{}, {});
  REQUIRE(sections.size() == 1);
  const SurfacePoint foot =
      nearestSurfacePoint(traced.scene(), sections[0].centre, 0, [](uint32_t face) { return face; });
  CHECK(2 * foot.distance == doctest::Approx(sections[0].diameter).epsilon(1e-12));
  CHECK(foot.side < 0);
  CHECK(sections[0].bound >= sections[0].diameter);
  CHECK(sections[0].bound <= (1 + kSectionTolerance) * sections[0].diameter * (1 + 1e-12));
  return traced.bvh.normalization.toMeshLength(sections[0].diameter);
}

double sectionOf(const Mesh& mesh) { return sectionOf(TracedMesh(mesh)); }

void checkSection(const Mesh& mesh, double expected) {
  const double found = sectionOf(mesh);
  CHECK(found <= expected * (1 + 1e-9));
  CHECK(found >= expected / (1 + kSectionTolerance));
}

/// A prism along z over an L: legs of these widths along x = 0 and y = 0, 4 long.
Mesh angleSection(double first, double second, double depth) {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {first}, {4}}, {{0}, {second}, {4}}, {0, depth},
                    [](uint32_t i, uint32_t j, uint32_t) { return i == 0 || j == 0; });
  return solid.surface();
}

/// The largest ball with its centre at a point of a grid.
double sectionOnGrid(const TracedMesh& traced, uint32_t count) {
  const Vec3d size = traced.geometry.bounds.size() * traced.bvh.normalization.scale;
  double radius = 0;
  for (uint32_t i = 0; i < count; ++i)
    for (uint32_t j = 0; j < count; ++j)
      for (uint32_t k = 0; k < count; ++k) {
        const auto along = [&](uint32_t step) { return (step + 0.5) / count - 0.5; };
        const SurfacePoint foot =
            nearestSurfacePoint(traced.scene(), {size.x * along(i), size.y * along(j), size.z * along(k)}, radius,
                                [](uint32_t face) { return face; });
        if (foot.side < 0) radius = std::max(radius, foot.distance);
      }
  return traced.bvh.normalization.toMeshLength(2 * radius);
}

/// Two boxes of 2 x 2, one on the other; the faces where they touch have the same vertices. heights: of the planes.
Mesh stackedBoxes(const std::array<double, 3>& heights, bool upperFirst) {
  Mesh mesh;
  for (const double z : heights)
    for (const Vec3d& v : {Vec3d{0, 0, z}, Vec3d{2, 0, z}, Vec3d{2, 2, z}, Vec3d{0, 2, z}}) mesh.vertices.push_back(v);
  for (const uint32_t base : {upperFirst ? 4u : 0u, upperFirst ? 0u : 4u})
    for (const Face& f : {Face{0, 2, 1}, Face{0, 3, 2}, Face{4, 5, 6}, Face{4, 6, 7}, Face{0, 1, 5}, Face{0, 5, 4},
                          Face{1, 2, 6}, Face{1, 6, 5}, Face{2, 3, 7}, Face{2, 7, 6}, Face{3, 0, 4}, Face{3, 4, 7}})
      mesh.faces.push_back({base + f[0], base + f[1], base + f[2]});
  return mesh;
}

}  // namespace

TEST_CASE("the section of a box is its least side, that of a sphere its inner diameter") {
  for (const Vec3d& size : {Vec3d{2, 2, 2}, Vec3d{7, 3, 1}, Vec3d{1, 1, 30}, Vec3d{9, 8, 0.05}})
    for (const uint32_t side : {1u, 4u}) checkSection(shapes::box(size, side), std::min({size.x, size.y, size.z}));
  const Mesh sphere = shapes::icosphere(2, 3);
  double inner = 3;
  const FaceGeometry geometry = computeFaceGeometry(sphere);
  for (size_t face = 0; face < sphere.faces.size(); ++face)
    inner = std::min(inner, dot(geometry.barycentres[face], geometry.normals[face]));
  CHECK(sectionOf(sphere) >= 2 * inner / (1 + kSectionTolerance));
  CHECK(sectionOf(sphere) <= 6);
}

TEST_CASE("the section between a box and its cavity is in the corners") {
  // Through the corners of both, with the radius r: sqrt(3) (1 - r) = r.
  const Mesh hollow = shapes::joined(shapes::box({4, 4, 4}), shapes::inverted(shapes::box({2, 2, 2})));
  checkSection(hollow, 2 * std::sqrt(3) / (1 + std::sqrt(3)));
}

TEST_CASE("the section of an L is at its inner corner, in any unit") {
  // (a - r)^2 + (b - r)^2 = r^2 for legs of a and b.
  for (const double unit : {1.0, 1e-3, 1e3}) {
    const Mesh mesh = shapes::scaledAndShifted(angleSection(1, 1.5, 2), unit, {5 * unit, 0, 0});
    checkSection(mesh, 2 * unit * (2.5 - std::sqrt(3)));
  }
  checkSection(angleSection(1, 1.5, 0.7), 0.7);
}

TEST_CASE("a thin plate does not hide a thick one behind a narrow gap") {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {1}, {20}}, {{0}, {2}, {2.1}, {5.1}}, {0, 20},
                    [](uint32_t i, uint32_t j, uint32_t) { return i == 0 || j != 1; });
  checkSection(solid.surface(), 3);
}

TEST_CASE("the plane of a concave floor does not limit the balls beside the floor") {
  // A plate with a pocket that is an arrow from above: its fourth corner is the concave one.
  const std::array<double, 4> plate{-12.502, 6.847, -4.783, 13.691};
  const double top = 9.44, floor = 2.49;
  Mesh mesh;
  for (const double z : {0.0, top})
    for (const auto& [x, y] : {std::array{1, 3}, std::array{0, 3}, std::array{0, 2}, std::array{1, 2}})
      mesh.vertices.push_back({plate[static_cast<size_t>(x)], plate[static_cast<size_t>(y)], z});
  for (const double z : {top, floor})
    for (const auto& [x, y] :
         {std::array{3.67, 12.0}, std::array{-12.0, 12.0}, std::array{-12.0, -3.14}, std::array{-1.11, 0.27}})
      mesh.vertices.push_back({x, y, z});
  for (const Face& f :
       {Face{5, 6, 10},   Face{1, 6, 5},   Face{7, 8, 11},  Face{1, 2, 6},    Face{7, 4, 8},    Face{0, 2, 1},
        Face{6, 11, 10},  Face{6, 7, 11},  Face{5, 10, 9},  Face{4, 9, 8},    Face{4, 5, 9},    Face{12, 14, 15},
        Face{12, 13, 14}, Face{15, 11, 8}, Face{15, 8, 12}, Face{14, 10, 11}, Face{14, 11, 15}, Face{13, 9, 10},
        Face{13, 10, 14}, Face{12, 8, 9},  Face{12, 9, 13}, Face{3, 4, 7},    Face{3, 0, 4},    Face{2, 7, 6},
        Face{2, 3, 7},    Face{0, 5, 4},   Face{0, 1, 5},   Face{0, 3, 2}})
    mesh.faces.push_back(f);
  CHECK(sectionOf(mesh) >= 7.957);
}

TEST_CASE("a turned solid has the same section") {
  for (const double angle : {0.3, 0.785, 1.1}) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (Mesh mesh : {angleSection(1, 1.5, 2), shapes::box({7, 3, 1}, 3)}) {
      for (Vec3d& v : mesh.vertices)
        v = {c * v.x - s * v.y, c * (s * v.x + c * v.y) - s * v.z, s * (s * v.x + c * v.y) + c * v.z};
      checkSection(mesh, mesh.faceCount() > 50 ? 1 : 2 * (2.5 - std::sqrt(3)));
    }
  }
}

TEST_CASE("few boxes are enough where the largest balls are in a row or in a layer") {
  const auto isFound = [](const Mesh& mesh, uint32_t boxCount) {
    const TracedMesh traced(mesh);
    return findGreatestSections(traced.scene(), std::vector<uint32_t>(mesh.faceCount()), std::vector<uint8_t>{1},
                                {.boxCount = boxCount}, {})
        .front()
        .isExact();
  };
  for (const uint32_t side : {1u, 6u}) {
    CHECK(isFound(shapes::box({90, 80, 0.5}, side), 40));
    CHECK(isFound(shapes::box({1, 1, 300}, side), 40));
  }
  CHECK(isFound(angleSection(1, 1.5, 2), 60));
  CHECK(isFound(angleSection(1, 1.5, 20), 300));
  for (const char* part : {"bracket-4", "ribbed-plate"}) CHECK(isFound(makeThicknessPart(part).solid.surface(), 150));
}

TEST_CASE("sections are those of a dense grid") {
  for (const Mesh& mesh :
       {angleSection(1, 1.5, 2), makeThicknessPart("round-cup").solid.surface(),
        makeThicknessPart("bracket-4").solid.surface(), makeThicknessPart("spike").solid.surface()}) {
    constexpr uint32_t kCount = 40;
    const TracedMesh traced(mesh);
    const double found = sectionOf(traced), onGrid = sectionOnGrid(traced, kCount);
    CHECK(found >= onGrid / (1 + kSectionTolerance));
    // The distance changes by at most the way to the nearest point of the grid.
    CHECK(found <= onGrid + traced.geometry.bounds.diagonal() / kCount);
  }
}

namespace {

/// The diameters of two solids of 12 faces each, in the unit of the mesh.
std::array<double, 2> sectionsOfTwo(const TracedMesh& traced) {
  std::vector<uint32_t> solidOf(12, 0);
  solidOf.resize(24, 1);
  const auto sections = findGreatestSections(traced.scene(), solidOf, std::vector<uint8_t>{1, 1}, SectionSearch{}, {});
  REQUIRE(sections.size() == 2);
  const Normalization& unit = traced.bvh.normalization;
  return {unit.toMeshLength(sections[0].diameter), unit.toMeshLength(sections[1].diameter)};
}

}  // namespace

TEST_CASE("solids that touch in coincident faces have sections of their own, in any order") {
  for (const bool upperFirst : {false, true}) {
    const TracedMesh traced(stackedBoxes({0, 0.5, 1.7}, upperFirst));
    CHECK(traced.bvh.primitiveFaces.size() == 24);
    const std::array<double, 2> diameters = sectionsOfTwo(traced);
    for (size_t i = 0; i < 2; ++i)
      CHECK(diameters[i] == doctest::Approx((i == 1) == upperFirst ? 0.5 : 1.2).epsilon(kSectionTolerance));
  }
}

TEST_CASE("the faces of other solids do not limit a section, also where solids go through each other") {
  const TracedMesh traced(shapes::joined(shapes::box({2, 2, 2}), shapes::box({2, 3, 1.5}), {0.9, 0.2, 0.1}));
  const std::array<double, 2> diameters = sectionsOfTwo(traced);
  for (size_t i = 0; i < 2; ++i) CHECK(diameters[i] == doctest::Approx(i == 0 ? 2 : 1.5).epsilon(kSectionTolerance));
}

TEST_CASE("solids that are not wanted have no section") {
  const TracedMesh traced(shapes::joined(shapes::grid(2), shapes::cube(), {9, 0, 0}));
  std::vector<uint32_t> solidOf(traced.mesh.faceCount(), 1);
  std::fill_n(solidOf.begin(), 8, 0);
  const auto sections = findGreatestSections(traced.scene(), solidOf, std::vector<uint8_t>{0, 1}, SectionSearch{}, {});
  REQUIRE(sections.size() == 2);
  CHECK(std::isinf(sections[0].diameter));
  CHECK(std::isinf(sections[0].bound));
  CHECK(traced.bvh.normalization.toMeshLength(sections[1].diameter) == doctest::Approx(2).epsilon(kSectionTolerance));
}

TEST_CASE("a stop request ends the search for sections") {
  const TracedMesh traced(shapes::cube());
  std::stop_source stop;
  stop.request_stop();
  test::requireFailure(
      [&] {
        (void)findGreatestSections(traced.scene(), std::vector<uint32_t>(12), std::vector<uint8_t>{1}, SectionSearch{},
                                   {stop.get_token(), {}});
      },
      ErrorCode::Cancelled);
}
