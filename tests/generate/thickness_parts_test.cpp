#include "generate/thickness_parts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "mesh/face_geometry.h"
#include "random_solids/random_boxes.h"
#include "support/brute_force_thickness.h"
#include "topology.h"

using namespace asdfvk;

namespace {

/// Over all faces, by brute force; without a greatest section.
double leastThicknessOf(const Mesh& mesh) {
  const test::BruteForceThickness thickness(mesh, -0.499, 0x1p-22 * boundsOfFiniteVertices(mesh).diagonal());
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) least = std::min(least, thickness.least(face));
  return least;
}

void checkSurface(const BlockSolid& solid) {
  const Mesh coarse = solid.surface();
  const double longestEdge = boundsOfFiniteVertices(coarse).diagonal() / 12;
  const Mesh fine = solid.surface({.longestEdge = longestEdge, .diagonalSeed = 2});
  for (const Mesh* mesh : {&coarse, &fine}) {
    const Topology topology = topologyOf(*mesh);
    CHECK(topology.badEdgeCount == 0);
    CHECK(topology.badVertexCount == 0);
    CHECK(topology.componentCount == 1);
    const std::vector<double> qualities = triangleQualities(*mesh);
    CHECK(*std::min_element(qualities.begin(), qualities.end()) > 1e-3);
  }
  CHECK(fine.faceCount() > coarse.faceCount());
  // Any other division has other values where a side is not planar, or not convex.
  CHECK(volumeOf(coarse) > 0);
  CHECK(volumeOf(fine) == doctest::Approx(volumeOf(coarse)).epsilon(1e-12));
  CHECK(areaOf(fine) == doctest::Approx(areaOf(coarse)).epsilon(1e-12));
  // Two edges of each triangle are edges of a divided block.
  const auto isLong = [&](const Face& face) {
    size_t count = 0;
    for (size_t i = 0; i < 3; ++i)
      count += length(fine.vertices[face[i]] - fine.vertices[face[(i + 1) % 3]]) > longestEdge * (1 + 1e-9) ? 1 : 0;
    return count > 1;
  };
  CHECK(std::none_of(fine.faces.begin(), fine.faces.end(), isLong));
}

}  // namespace

TEST_CASE("the surface of a part is closed, and the same for each division") {
  for (const std::string_view name : thicknessPartNames()) {
    CAPTURE(name);
    checkSurface(makeThicknessPart(name).solid);
  }
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    checkSurface(makeSoundBox(seed, 1).solid);
    checkSurface(makeBoxWithThinPlace(seed, 1).solid);
  }
}

TEST_CASE("the known least thickness of a part is that of brute force") {
  for (const std::string_view name : thicknessPartNames()) {
    CAPTURE(name);
    const ThicknessPart part = makeThicknessPart(name);
    const Mesh mesh = part.solid.surface();
    const double least = leastThicknessOf(mesh);
    if (part.leastThickness > 0)
      CHECK(least == doctest::Approx(part.leastThickness).epsilon(1e-9));
    else
      CHECK(least < 1e-4);
    CHECK((part.leastThickness > 0) == (part.sharpAngleDegrees == 0));
  }
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const ThicknessPart sound = makeSoundBox(seed, 2), thin = makeBoxWithThinPlace(seed, 2);
    CHECK(leastThicknessOf(sound.solid.surface()) == doctest::Approx(sound.leastThickness).epsilon(1e-9));
    CHECK(leastThicknessOf(thin.solid.surface()) == doctest::Approx(thin.leastThickness).epsilon(1e-9));
    CHECK(sound.leastThickness >= 2);
    CHECK(thin.leastThickness < 2);
  }
}

TEST_CASE("the coarsest wedge has 12 faces, and parts have their seeds and their names") {
  CHECK(makeThicknessPart("wedge").solid.surface().faceCount() == 12);
  CHECK(makeThicknessPart("knife").solid.surface().faceCount() == 8);
  CHECK(makeThicknessPart("spike").solid.surface().faceCount() == 6);
  CHECK(thicknessPartNames().size() == 20);
  CHECK_THROWS((void)makeThicknessPart("no part"));
  const BlockSolid solid = makeThicknessPart("thick-cube").solid;
  CHECK(solid.surface({.diagonalSeed = 1}).faces == solid.surface({.diagonalSeed = 1}).faces);
  CHECK(solid.surface({.diagonalSeed = 1}).faces != solid.surface({.diagonalSeed = 2}).faces);
  CHECK(makeSoundBox(1, 1).leastThickness != makeSoundBox(2, 1).leastThickness);
}
