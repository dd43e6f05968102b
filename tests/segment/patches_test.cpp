#include "segment/patches.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "generate/analytic_shapes.h"
#include "part_samples.h"
#include "support/shapes.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

struct Surface {
  PartSample sample;
  PartSurface surface;

  explicit Surface(const Mesh& mesh, double value = 1)
      : sample(mesh, std::vector<double>(mesh.faces.size(), value)),
        surface(makePartSurface(sample.mesh, sample.geometry, sample.edges.graph, sample.values)) {}
};

}  // namespace

TEST_CASE("the surface has the area 1, lengths without a unit, and the angles of its edges") {
  const Surface cube(makeCube(12, 10).mesh, 5);
  double area = 0;
  for (const float a : cube.surface.areas) area += double{a};
  CHECK(area == doctest::Approx(1));
  CHECK(cube.surface.meshLength == doctest::Approx(std::sqrt(600.0)));
  CHECK(double{cube.surface.logValues[0]} == doctest::Approx(std::log(5 / std::sqrt(600.0))));
  for (size_t arc = 0; arc < cube.surface.arcs.size(); ++arc) {
    const double edge = double{cube.surface.edgeLengths[arc]} * std::sqrt(600.0);
    const bool isDiagonal = edge > 11;
    CHECK(edge == doctest::Approx(isDiagonal ? std::sqrt(200.0) : 10));
    CHECK(double{cube.surface.angles[arc]} == doctest::Approx(isDiagonal ? 0 : -std::acos(-1.0) / 2));
    // Convex edges and equal values lengthen nothing.
    CHECK(cube.surface.creasedArcs[arc].length == cube.surface.arcs[arc].length);
  }
}

TEST_CASE("arcs without a finite length are no way to a face") {
  Surface sphere(makeSphere(320).mesh);
  constexpr uint32_t kCut = 100;  // No arc enters or leaves it.
  for (uint32_t face = 0; face < 320; ++face)
    for (uint32_t arc = sphere.surface.offsets[face]; arc < sphere.surface.offsets[face + 1]; ++arc)
      if (PartSurface::Arc& creased = sphere.surface.creasedArcs[arc]; face == kCut || creased.face == kCut)
        creased.length = arc % 2 == 0 ? std::nanf("") : INFINITY;
  const std::vector<uint32_t> seeds{0}, counts{8};
  const Patches patches = makePatches(sphere.surface, seeds, counts)[0];
  CHECK(patches.count == 8);
  for (uint32_t face = 0; face < 320; ++face) CHECK((patches.patchOf[face] < 8) == (face != kCut));
  const PatchData data = describePatches(sphere.surface, sphere.sample.geometry.normals, patches);
  for (const PatchData::Border& border : data.borders) CHECK(border.b < 8);
}

TEST_CASE("two faces with several common edges have an arc for each") {
  const Surface flat(Mesh{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {2, 1, 0}}, {}});
  REQUIRE(flat.surface.arcs.size() == 6);
  double perimeter = 0;
  for (size_t arc = 0; arc < 3; ++arc) perimeter += double{flat.surface.edgeLengths[arc]};
  CHECK(perimeter * flat.surface.meshLength == doctest::Approx(12));
}

TEST_CASE("a missing value is that of the nearest face, and a component without any has the mean") {
  Mesh mesh = makeSphere(80).mesh;
  mesh = shapes::joined(std::move(mesh), makeSphere(20).mesh, {5, 0, 0});
  std::vector<double> values(100, std::nan(""));
  values[0] = 1;
  values[70] = 4;
  const PartSample sample(mesh, values);
  const PartSurface surface = makePartSurface(sample.mesh, sample.geometry, sample.edges.graph, sample.values);
  const float low = surface.logValues[0], high = surface.logValues[70];
  for (uint32_t face = 0; face < 80; ++face) CHECK((surface.logValues[face] == low || surface.logValues[face] == high));
  for (const uint32_t other : sample.edges.graph.neighboursOf(70)) CHECK(surface.logValues[other] == high);
  for (uint32_t face = 80; face < 100; ++face)
    CHECK(double{surface.logValues[face]} == doctest::Approx((double{low} + double{high}) / 2));
}

TEST_CASE("patches cover the surface, are connected, and have about equal areas") {
  const Surface sphere(makeSphere(2000).mesh);
  const std::vector<uint32_t> seeds{3};
  const std::vector<Patches> all = makePatches(sphere.surface, seeds, std::vector<uint32_t>{10, 40});
  REQUIRE(all.size() == 2);
  for (const Patches& patches : all) {
    CAPTURE(patches.count);
    CHECK(areConsecutive(patches.patchOf, patches.count));
    std::vector<double> areas(patches.count, 0);
    for (uint32_t face = 0; face < patches.patchOf.size(); ++face)
      areas[patches.patchOf[face]] += double{sphere.surface.areas[face]};
    const auto [least, greatest] = std::minmax_element(areas.begin(), areas.end());
    CHECK(*greatest < 4 * *least);
    // Connected: each face has a path within the patch to the face at the centre.
    const PatchData data = describePatches(sphere.surface, sphere.sample.geometry.normals, patches);
    std::vector<uint8_t> isReached(patches.patchOf.size(), 0);
    std::vector<uint32_t> stack;
    for (const PatchData::Patch& patch : data.patches) {
      isReached[patch.centreFace] = 1;
      stack.push_back(patch.centreFace);
    }
    while (!stack.empty()) {
      const uint32_t face = stack.back();
      stack.pop_back();
      for (const uint32_t other : sphere.sample.edges.graph.neighboursOf(face))
        if (!isReached[other] && patches.patchOf[other] == patches.patchOf[face]) {
          isReached[other] = 1;
          stack.push_back(other);
        }
    }
    CHECK(std::count(isReached.begin(), isReached.end(), 0) == 0);
  }
  CHECK(all[0].count == 10);
  CHECK(all[1].count == 40);
}

TEST_CASE("components without a seed have no patch, and a patch per face is the most") {
  Mesh mesh = makeSphere(80).mesh;
  mesh = shapes::joined(std::move(mesh), makeSphere(20).mesh, {5, 0, 0});
  const Surface both(mesh);
  const std::vector<uint32_t> first{0}, second{0, 90};
  const Patches one = makePatches(both.surface, first, std::vector<uint32_t>{7})[0];
  CHECK(one.count == 7);
  CHECK(std::all_of(one.patchOf.begin() + 80, one.patchOf.end(), [](uint32_t patch) { return patch == kNoPatch; }));
  CHECK(std::count(one.patchOf.begin(), one.patchOf.begin() + 80, kNoPatch) == 0);
  const Patches most = makePatches(both.surface, second, std::vector<uint32_t>{400})[0];
  CHECK(most.count == 100);
  CHECK(areConsecutive(most.patchOf, 100));
  CHECK(makePatches(both.surface, second, std::vector<uint32_t>{1})[0].count == 2);
}

TEST_CASE("borders of patches run along concave edges") {
  // Two boxes that meet at a concave edge: an L of 40 by 40 steps.
  Mesh mesh;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) mesh.vertices.push_back({i < 20 ? 0.0 : i - 20.0, j * 1.0, i < 20 ? 20.0 - i : 0.0});
  for (uint32_t i = 0; i < 40; ++i)
    for (uint32_t j = 0; j < 40; ++j) {
      const uint32_t a = i * 41 + j, b = a + 41;
      mesh.faces.push_back({a, b, b + 1});
      mesh.faces.push_back({a, b + 1, a + 1});
    }
  const Surface fold(mesh);
  const std::vector<uint32_t> seeds{0};
  const Patches patches = makePatches(fold.surface, seeds, std::vector<uint32_t>{200})[0];
  const PatchData data = describePatches(fold.surface, fold.sample.geometry.normals, patches);
  double concave = 0;
  for (const PatchData::Border& border : data.borders) concave += border.concave;
  const double creaseLength = 40 / fold.surface.meshLength;
  CHECK(concave > 0.8 * creaseLength * std::acos(-1.0) / 2);
}
