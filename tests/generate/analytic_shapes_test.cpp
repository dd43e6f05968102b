#include <doctest/doctest.h>

#include <numbers>

#include "asdf_vk/error.h"
#include "generate/shapes.h"
#include "topology.h"

using namespace asdfvk;

namespace {

constexpr double kPi = std::numbers::pi;

void checkConvergence(GeneratedShape (*make)(uint64_t), double volume, double area) {
  const Mesh coarse = make(1000).mesh, fine = make(64000).mesh;
  CHECK(volumeOf(fine) == doctest::Approx(volume).epsilon(2e-3));
  CHECK(areaOf(fine) == doctest::Approx(area).epsilon(2e-3));
  // The error of a chordal surface falls with the square of the edge, here to a 64th.
  CHECK(std::abs(volumeOf(fine) - volume) < std::abs(volumeOf(coarse) - volume) / 30);
  CHECK(std::abs(areaOf(fine) - area) < std::abs(areaOf(coarse) - area) / 30);
}

}  // namespace

TEST_CASE("volume and area of a sphere converge to the exact ones") {
  checkConvergence([](uint64_t n) { return makeSphere(n, 2); }, 32 * kPi / 3, 16 * kPi);
  checkConvergence([](uint64_t n) { return makeIcosphere(n); }, 4 * kPi / 3, 4 * kPi);
}

TEST_CASE("volume and area of a torus converge to the exact ones") {
  checkConvergence([](uint64_t n) { return makeTorus(n, 1, 0.3); }, 2 * kPi * kPi * 0.09, 4 * kPi * kPi * 0.3);
}

TEST_CASE("volume and area of a cylinder converge to the exact ones") {
  checkConvergence([](uint64_t n) { return makeCylinder(n, 0.5, 3); }, kPi * 0.25 * 3, kPi * 3 + kPi * 0.5);
}

TEST_CASE("a box has its exact volume and area at any resolution") {
  for (uint64_t count : {20, 1000, 20000}) {
    const Mesh mesh = makeBox(count, {1, 2, 0.25}).mesh;
    CHECK(volumeOf(mesh) == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(areaOf(mesh) == doctest::Approx(2 * (2 + 0.5 + 0.25)).epsilon(1e-12));
  }
}

TEST_CASE("the icosphere has 20 * 4^n faces with all its vertices on the sphere") {
  CHECK(makeIcosphere(320).mesh.faceCount() == 320);
  const GeneratedShape shape = makeIcosphere(20000);
  CHECK(shape.mesh.faceCount() == 20480);
  for (const Vec3d& p : shape.mesh.vertices) REQUIRE(length(p) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("analytic shapes have their exact diameter") {
  const auto checkDiameter = [](const GeneratedShape& shape, double expected) {
    REQUIRE(shape.diameter.size() == shape.mesh.faces.size());
    for (float diameter : shape.diameter) REQUIRE(diameter == static_cast<float>(expected));
  };
  checkDiameter(makeSphere(500, 2), 4);
  checkDiameter(makeIcosphere(320), 2);
  checkDiameter(makeSlab(500, 3, 0.2), 0.2);
  checkDiameter(makeCylinder(500, 0.5, 9), 1);
  checkDiameter(makeTorus(500, 2, 0.4), 0.8);
  checkDiameter(makeCube(500, 0.7), 0.7);
}

TEST_CASE("an unknown shape and an impossible count are usage errors that name the choices") {
  CHECK_THROWS_WITH_AS((void)generateShape("teapot", 100), doctest::Contains("sphere"), Error);
  CHECK_THROWS_WITH_AS((void)generateShape("sphere", 3), doctest::Contains("20"), Error);
  CHECK_THROWS_AS((void)generateShape("sphere", kMaxFaceCount + 1), Error);
}
