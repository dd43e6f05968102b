#include "trace/sharp_edges.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "generate/thickness_parts.h"
#include "support/separated_faces.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

constexpr double kDegrees = std::numbers::pi / 180;

SharpEdges sharpEdgesOf(const Mesh& mesh) {
  // Walls at 120 degrees, with slack; depths relative to the box as in the wall check.
  return findSharpEdges(mesh, computeFaceGeometry(mesh), PointFans(mesh), -0.499,
                        0x1p-22 * boundsOfFiniteVertices(mesh).diagonal());
}

double angleOf(const SharpLine& line) { return std::acos(line.cosine) / kDegrees; }

Mesh part(const char* name, double longestEdge = 1e9) {
  return makeThicknessPart(name).solid.surface({.longestEdge = longestEdge});
}

/// A prism along y whose cross-section has its tip at x = 0, with this angle; each end is a fan of triangles around it.
/// wallPosition: number of triangles of each end that precede the two walls.
Mesh prism(double angleDegrees, uint32_t endCount, uint32_t wallPosition) {
  const double half = std::tan(angleDegrees / 2 * kDegrees);
  Mesh mesh{{{0, 0, 0}, {0, 2, 0}}, {}, {}};
  for (uint32_t i = 0; i <= endCount; ++i)
    for (const double y : {0.0, 2.0}) mesh.vertices.push_back({1, y, half * (2.0 * i / endCount - 1)});
  for (uint32_t i = 0; i < endCount; ++i) {
    const uint32_t low = 2 + 2 * i, high = low + 2;
    if (i == wallPosition) {
      const uint32_t top = 2 + 2 * endCount;
      for (const Face& face : {Face{0, 1, 2}, Face{0, top, 1}, Face{2, 1, 3}, Face{top, top + 1, 1}})
        mesh.faces.push_back(face);
    }
    for (const Face& face :
         {Face{0, low, high}, Face{1, high + 1, low + 1}, Face{low, low + 1, high + 1}, Face{low, high + 1, high}})
      mesh.faces.push_back(face);
  }
  return mesh;
}

/// A cylinder along z with a pit: its radii along the axis, at heights 0, 5 and 10.
Mesh pitted(uint32_t sideCount, const std::array<double, 3>& radii) {
  BlockSolid solid;
  solid.addLattice(
      {1, sideCount, 2},
      [&](uint32_t i, uint32_t j, uint32_t k) {
        const double angle = 2 * std::numbers::pi * (j % sideCount) / sideCount, radius = i == 0 ? radii[k] : 8;
        return Vec3d{radius * std::cos(angle), radius * std::sin(angle), 5.0 * k};
      },
      [](uint32_t, uint32_t, uint32_t) { return true; });
  return solid.surface();
}

/// A block with a slot along y whose walls meet at its bottom.
Mesh slotted() {
  BlockSolid solid;
  solid.addLattice(
      {3, 1, 2},
      [](uint32_t i, uint32_t j, uint32_t k) {
        const double half = k == 2 ? 1 : 0, xs[] = {-10, -half, half, 10};
        return Vec3d{xs[i], 20.0 * j, 5.0 * k};
      },
      [](uint32_t i, uint32_t, uint32_t) { return i != 1; });
  return solid.surface();
}

/// A pyramid over a regular polygon of radius 1, without its base.
Mesh needle(uint32_t sideCount, double height) {
  Mesh mesh{{{0, 0, height}}, {}, {}};
  for (uint32_t i = 0; i < sideCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / sideCount;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0});
    mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % sideCount});
  }
  return mesh;
}

}  // namespace

TEST_CASE("the edge of a knife is one line, with its angle and length, at any triangulation") {
  for (const double longestEdge : {1e9, 8.0, 3.0}) {
    const Mesh mesh = part("knife", longestEdge);
    for (const Mesh& each : {mesh, separated(mesh)}) {
      CAPTURE(each.vertices.size());
      const SharpEdges sharp = sharpEdgesOf(each);
      REQUIRE(sharp.lines.size() == 1);
      CHECK(angleOf(sharp.lines[0]) == doctest::Approx(std::atan(5.0 / 60) / kDegrees));
      CHECK(sharp.lines[0].length == doctest::Approx(20));
      CHECK(sharp.lines[0].edgeCount == (longestEdge > 20 ? 1 : longestEdge == 8 ? 3 : 7));
      CHECK(sharp.lines[0].place.x == 0);
      CHECK(sharp.lines[0].place.z == 0);
    }
  }
}

TEST_CASE("faces of a knife are marked at its edge and at the corners there, its ends are not") {
  const Mesh mesh = part("knife", 8);
  for (const Mesh& each : {mesh, separated(mesh)}) {
    const SharpEdges sharp = sharpEdgesOf(each);
    const FaceGeometry geometry = computeFaceGeometry(each);
    for (uint32_t face = 0; face < each.faces.size(); ++face)
      for (size_t k = 0; k < 3; ++k) {
        const bool isAtEdge = each.vertices[each.faces[face][k]].x == 0;
        const bool isNextAtEdge = each.vertices[each.faces[face][(k + 1) % 3]].x == 0;
        CHECK(sharp.hasCorner(face, k) == (isAtEdge && std::abs(geometry.normals[face].y) < 0.5));
        CHECK(sharp.hasEdge(face, k) == (isAtEdge && isNextAtEdge));
      }
  }
}

TEST_CASE("the tip of a narrow pyramid has no length, and the angle between its sides") {
  for (const double longestEdge : {1e9, 3.0}) {
    const Mesh mesh = part("spike", longestEdge);
    for (const Mesh& each : {mesh, separated(mesh)}) {
      const SharpEdges sharp = sharpEdgesOf(each);
      REQUIRE(sharp.lines.size() == 1);
      CHECK(sharp.lines[0].length == 0);
      CHECK(sharp.lines[0].edgeCount == 0);
      CHECK(angleOf(sharp.lines[0]) == doctest::Approx(2 * std::atan(0.1) / kDegrees));
      CHECK(sharp.lines[0].place == Vec3d{0, 0, 20});
      for (const uint8_t bits : sharp.faceBits) CHECK(bits < 8);  // No edge.
    }
  }
}

TEST_CASE("edges are sharp below 60 degrees, and lines are sorted by their angles") {
  const SharpEdges wide = sharpEdgesOf(prism(62, 1, 0));  // The other two edges have 59 degrees.
  REQUIRE(wide.lines.size() == 2);
  for (const SharpLine& line : wide.lines) {
    CHECK(angleOf(line) == doctest::Approx(59));
    CHECK(line.place.x == 1);
  }
  for (const double angle : {58.0, 30.0, 1.0}) {
    const SharpEdges sharp = sharpEdgesOf(prism(angle, 1, 0));
    REQUIRE(sharp.lines.size() == 1);
    CHECK(angleOf(sharp.lines[0]) == doctest::Approx(angle));
    CHECK(sharp.lines[0].length == doctest::Approx(2));
  }
  const SharpEdges two = sharpEdgesOf(shapes::joined(prism(40, 1, 0), prism(20, 1, 0), {0, 0, 9}));
  REQUIRE(two.lines.size() == 2);
  CHECK(angleOf(two.lines[0]) == doctest::Approx(20));
  CHECK(two.lines[0].place == Vec3d{0, 1, 9});
  CHECK(two.lines[0].face >= 8);
  CHECK(angleOf(two.lines[1]) == doctest::Approx(40));
}

TEST_CASE("cubes, spheres, concave cones, re-entrant slots and doubled sheets have no sharp edge") {
  const Mesh sheet = shapes::grid(2);
  Mesh doubled = sheet;
  for (const auto& [a, b, c] : sheet.faces) doubled.faces.push_back({a, c, b});
  for (const Mesh& mesh : {shapes::cube(), shapes::sphere(2), pitted(24, {0, 0, 2}), pitted(24, {0, 0, 8 * 0.2}),
                           slotted(), shapes::inverted(part("knife")), shapes::inverted(part("spike")), doubled})
    for (const Mesh& each : {mesh, separated(mesh)}) {
      CAPTURE(each.faces.size());
      const SharpEdges sharp = sharpEdgesOf(each);
      CHECK(sharp.lines.empty());
      CHECK(std::all_of(sharp.faceBits.begin(), sharp.faceBits.end(), [](uint8_t bits) { return bits == 0; }));
    }
}

TEST_CASE("a fan of very many faces has its tip, and an edge between any two of its faces") {
  constexpr uint32_t kFaceCount = 3 * kMaxComparedFaces - 90;
  const SharpEdges tip = sharpEdgesOf(needle(kFaceCount, 10));
  REQUIRE(tip.lines.size() == 1);
  CHECK(angleOf(tip.lines[0]) == doctest::Approx(2 * std::atan(0.1) / kDegrees).epsilon(1e-3));
  CHECK(tip.lines[0].length == 0);
  // One of each two successive places is left out of the comparison of all faces.
  for (uint32_t wallPosition = 0; wallPosition < 6; ++wallPosition) {
    CAPTURE(wallPosition);
    const SharpEdges edge = sharpEdgesOf(prism(25, kFaceCount, wallPosition));
    REQUIRE(edge.lines.size() == 1);
    CHECK(edge.lines[0].length == doctest::Approx(2));
    CHECK(angleOf(edge.lines[0]) == doctest::Approx(25));
  }
}

TEST_CASE("degenerate faces and corners that are not finite are not sharp") {
  Mesh mesh = part("knife");
  mesh.faces.push_back({0, 0, 1});
  mesh.vertices.push_back({std::nan(""), 0, 0});
  mesh.faces.push_back({0, 1, static_cast<uint32_t>(mesh.vertices.size()) - 1});
  const SharpEdges sharp = sharpEdgesOf(mesh);
  CHECK(sharp.lines.size() == 1);
  CHECK(sharp.faceBits[mesh.faces.size() - 1] == 0);
  CHECK(sharp.faceBits[mesh.faces.size() - 2] == 0);
}
