#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "asdf_vk/scene.h"
#include "core/vec3.h"
#include "generate/solids.h"
#include "support/shapes.h"
#include "support/shared_session.h"

// Sealed voids, and the greatest thickness of bodies (docs/thickness.md#gaps-voids-and-thick-bodies).

using namespace asdfvk;

namespace {

Report measureSpace(const Mesh& mesh) {
  Options options;
  options.measure = Measure::Gap;
  return test::referenceSession().compute(mesh, options).report;
}

Mesh placedBox(const Vec3d& min, const Vec3d& max) {
  return shapes::scaledAndShifted(shapes::box(max - min), 1, (min + max) / 2.0);
}

Mesh allOf(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& each : meshes) all = shapes::joined(std::move(all), each);
  return all;
}

/// Six plates around a space of 8 x 8 x (8 - overlap): they touch, or overlap.
Mesh sealedPlates(double overlap) {
  const double h = overlap / 2;
  return allOf({placedBox({0, 0, 0}, {10, 10, 1 + h}), placedBox({0, 0, 9 - h}, {10, 10, 10}),
                placedBox({0, 0, 1}, {10, 1, 9}), placedBox({0, 9, 1}, {10, 10, 9}), placedBox({0, 1, 1}, {1, 9, 9}),
                placedBox({9, 1, 1}, {10, 9, 9})});
}

}  // namespace

TEST_CASE("a cavity is a sealed void, with its volume and a place on it") {
  const Mesh mesh = shapes::joined(shapes::box({10, 10, 10}), shapes::inverted(shapes::box({4, 4, 4})), {1, 0, 0});
  for (const Mesh& each : {mesh, solids::separated(mesh)}) {
    const Report report = measureSpace(each);
    REQUIRE(report.voids.size() == 1);
    const SealedVoid& found = report.voids[0];
    CHECK(found.volume == doctest::Approx(64));
    CHECK(found.size == Vec3d{4, 4, 4});
    CHECK(found.face >= 12);
    CHECK(std::max({std::abs(found.place.x - 1), std::abs(found.place.y), std::abs(found.place.z)}) ==
          doctest::Approx(2));
    CHECK(found.looseBodies.empty());
    CHECK(report.gap->min == doctest::Approx(4).epsilon(0.05));
  }
}

TEST_CASE("a body that lies loose in a void is named, and takes its volume") {
  Mesh mesh = allOf({shapes::box({10, 10, 10}), shapes::inverted(shapes::box({4, 4, 4})), shapes::box({2, 2, 2})});
  CHECK(measureSpace(mesh).voids.at(0).looseBodies == std::vector<std::string>{"component 2"});
  mesh.objects = {{0, "housing"}, {24, "ball"}};
  const Report report = measureSpace(mesh);
  REQUIRE(report.voids.size() == 1);
  CHECK(report.voids[0].volume == doctest::Approx(64 - 8));
  CHECK(report.voids[0].looseBodies == std::vector<std::string>{"ball"});
  CHECK(report.gap->min == doctest::Approx(1));
}

TEST_CASE("bodies around a void seal it if they touch or overlap, and not with a gap between them") {
  for (const double overlap : {0.0, 1.0}) {
    CAPTURE(overlap);
    const Mesh plates = sealedPlates(overlap);
    for (const Mesh& mesh : {plates, solids::separated(plates)}) {
      const Report report = measureSpace(mesh);
      CHECK(report.gap->unjudged.reasons.empty());
      REQUIRE(report.voids.size() == 1);
      CHECK(report.voids[0].volume == doctest::Approx(64 * (8 - overlap)));
      CHECK(report.contacts.size() == 12);
    }
  }
  Mesh open = sealedPlates(1);
  for (size_t i = 0; i < 8; ++i) open.vertices[i].z -= 1.6;  // The first plate.
  CHECK(measureSpace(open).voids.empty());
}

TEST_CASE("bodies without a void have none: solid, in contact, a tube, inverted, open") {
  CHECK(measureSpace(shapes::cube()).voids.empty());
  CHECK(measureSpace(shapes::doubledCube()).voids.empty());
  CHECK(measureSpace(shapes::boxesWithSharedEdge()).voids.empty());
  CHECK(measureSpace(shapes::torus(2, 0.5, 24, 12)).voids.empty());
  CHECK(measureSpace(shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0})).voids.empty());
  CHECK(measureSpace(shapes::inverted(shapes::cube())).voids.empty());
  CHECK(measureSpace(shapes::openBox({2, 2, 2}, 1)).voids.empty());
  // A cavity that another body fills.
  CHECK(
      measureSpace(allOf({shapes::box({10, 10, 10}), shapes::inverted(shapes::box({4, 4, 4})), shapes::box({5, 5, 5})}))
          .voids.empty());
}

TEST_CASE("several voids, also in nested bodies") {
  // A hollow body in the void of another one.
  const Report nested = measureSpace(allOf({shapes::box({20, 20, 20}), shapes::inverted(shapes::box({16, 16, 16})),
                                            shapes::box({10, 10, 10}), shapes::inverted(shapes::box({6, 6, 6}))}));
  REQUIRE(nested.voids.size() == 2);
  CHECK(nested.voids[0].volume == doctest::Approx(16 * 16 * 16 - 1000));
  CHECK(nested.voids[1].volume == doctest::Approx(216));
  CHECK(nested.voids[0].looseBodies == std::vector<std::string>{"component 2"});
  CHECK(nested.voids[1].looseBodies.empty());
}

TEST_CASE("voids, contacts and thick bodies of a region are those with a face in it") {
  // A box; one with a cavity, in which a body lies, and that touches the first box; a thick box.
  const Mesh mesh = allOf({placedBox({0, 0, 0}, {2, 2, 2}), placedBox({2, 0, 0}, {8, 6, 6}),
                           shapes::inverted(placedBox({3, 1, 1}, {7, 5, 5})), placedBox({4, 2, 2}, {5, 3, 3}),
                           placedBox({20, 0, 0}, {28, 9, 9}), placedBox({28, 0, 0}, {29, 9, 9})});
  Scene scene(test::referenceSession(), mesh);
  Options options;
  options.measure = Measure::ThicknessAndGap;
  options.thickness.thickerThan = 7;
  const auto measure = [&](std::initializer_list<size_t> bodies) {
    std::vector<uint8_t> region(mesh.faces.size());
    for (const size_t body : bodies) std::fill_n(region.begin() + static_cast<ptrdiff_t>(12 * body), 12, uint8_t{1});
    return scene.compute(options, region).report;
  };
  const Report first = measure({0}), hollow = measure({1}), cavity = measure({2}), loose = measure({3}),
               thick = measure({4});
  CHECK(first.voids.empty());
  CHECK(hollow.voids.empty());
  CHECK(thick.voids.empty());
  for (const Report& report : {cavity, loose}) {
    REQUIRE(report.voids.size() == 1);
    CHECK(report.voids[0].volume == doctest::Approx(64 - 1));
  }
  CHECK(cavity.voids[0].face / 12 == 2);
  CHECK(loose.voids[0].face / 12 == 3);
  using Names = std::vector<std::string>;
  REQUIRE(first.contacts.size() == 1);
  CHECK(first.contacts[0].bodies == Names{"component 0", "component 1"});
  CHECK(hollow.contacts.size() == 1);
  CHECK(loose.contacts.empty());
  CHECK(thick.contacts.size() == 1);
  CHECK(first.thickness->thick->verdict == ThicknessVerdict::Passed);
  CHECK(first.thickness->greatestSection->diameter < 3);
  REQUIRE(thick.thickness->thick->bodies.size() == 1);
  CHECK(thick.thickness->thick->bodies[0].diameter == doctest::Approx(9).epsilon(0.01));
  const Report whole = scene.compute(options).report;
  CHECK(whole.voids.size() == 1);
  CHECK(whole.contacts.size() == 2);
  CHECK(whole.thickness->thick->bodies.size() == 1);
}

TEST_CASE("the greatest ball of each body is compared with a limit") {
  const Mesh mesh = shapes::joined(shapes::box({8, 6, 2}), shapes::box({3, 3, 3}), {10, 0, 0});
  const auto judge = [&](double limit) {
    Options options;
    options.thickness.thickerThan = limit;
    options.thickness.findsNextWall = true;
    return *test::referenceSession().compute(mesh, options).report.thickness;
  };
  const ThicknessReport passed = judge(3.01), one = judge(2.9), both = judge(1.9);
  CHECK(passed.thick->verdict == ThicknessVerdict::Passed);
  CHECK(passed.thick->bodies.empty());
  CHECK(passed.thick->ratio == doctest::Approx(1.5).epsilon(0.01));
  CHECK_FALSE(passed.verdict);
  CHECK(one.thick->verdict == ThicknessVerdict::Failed);
  REQUIRE(one.thick->bodies.size() == 1);
  CHECK(one.thick->bodies[0].diameter == doctest::Approx(3).epsilon(0.002));
  CHECK(one.thick->bodies[0].centre.x == doctest::Approx(10).epsilon(0.01));
  CHECK(one.thick->bodies[0].bodies == std::vector<std::string>{"component 1"});
  REQUIRE(both.thick->bodies.size() == 2);
  CHECK(both.thick->bodies[1].diameter == doctest::Approx(2).epsilon(0.002));
  Options options;
  options.thickness.thickerThan = 0.5;
  options.thickness.thinnerThan = 1;
  const Report open = test::referenceSession().compute(shapes::openBox({2, 2, 2}, 1), options).report;
  CHECK(open.thickness->thick->verdict == ThicknessVerdict::NotJudged);
}
