#include "brute_force.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "reference_ray.h"
#include "support/shapes.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

struct Difference {
  size_t rayCount = 0, validRayCount = 0;
  size_t differingRays = 0, differingFaces = 0;
  uint32_t worstFace = 0;
};

constexpr ConeOptions kCgalCone{.rayCount = 25, .definition = Definition::Cgal};

bool agree(double a, double b, double tolerance) {
  return std::isnan(a) ? std::isnan(b) : std::abs(a - b) <= tolerance;
}

// At most `maxFaces` faces, spread over the mesh.
Difference compareWithBruteForce(const Mesh& source, uint32_t maxFaces, const ConeOptions& options = {}) {
  const TracedMesh traced(source);
  const Cone cone = makeCone(options);
  const double tolerance = 1e-10 * traced.geometry.bounds.diagonal();
  Difference difference;
  const uint32_t step = std::max(1u, traced.mesh.faceCount() / maxFaces);
  for (uint32_t face = 0; face < traced.mesh.faceCount(); face += step) {
    const BruteForceCone expected = traceByBruteForce(traced.mesh, cone, face);
    const ConeFrame frame = seedConeFrame(traced.scene(), cone, face);
    for (size_t i = 0; i < cone.directions.size(); ++i) {
      const Vec3d& d = cone.directions[i];
      const double length = referenceRayLength(traced.scene(), cone,
                                               d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis, face);
      ++difference.rayCount;
      difference.validRayCount += std::isnan(length) ? 0 : 1;
      difference.differingRays += agree(length, expected.rayLengths[i], tolerance) ? 0 : 1;
    }
    if (!agree(referenceCone(traced.scene(), cone, face), expected.value, tolerance)) {
      ++difference.differingFaces;
      difference.worstFace = face;
    }
  }
  return difference;
}

void checkAgainstBruteForce(const std::string& name, const Mesh& mesh, uint32_t maxFaces = 400,
                            const ConeOptions& options = {}) {
  CAPTURE(name);
  const Difference difference = compareWithBruteForce(mesh, maxFaces, options);
  CAPTURE(difference.worstFace);
  CHECK(difference.differingRays == 0);
  CHECK(difference.differingFaces == 0);
  CHECK(difference.validRayCount * 20 > difference.rayCount);
}

}  // namespace

TEST_CASE("every ray and face of closed shapes is as brute force has it") {
  checkAgainstBruteForce("icosphere", shapes::icosphere(3));
  checkAgainstBruteForce("dented sphere", shapes::jittered(shapes::icosphere(3), 0.05, 1));
  checkAgainstBruteForce("box", shapes::box({1, 2, 3}, 6));
  checkAgainstBruteForce("jittered box", shapes::jittered(shapes::box({1, 2, 3}, 6), 0.02, 2));
  // An odd number of sides: two at a right angle would be false intersections or not by rounding.
  checkAgainstBruteForce("cylinder", shapes::cylinder(1, 5, 25, 8));
  checkAgainstBruteForce("shell", shapes::shell(1, 0.7));
}

TEST_CASE("every ray and face of open, crossing and non-manifold shapes is as brute force has it") {
  checkAgainstBruteForce("open box", shapes::openBox({1, 1, 1}, 6));
  checkAgainstBruteForce("soup", shapes::soup(300, 3));
  checkAgainstBruteForce("boxes with a shared edge", shapes::boxesWithSharedEdge());
  checkAgainstBruteForce(
      "two spheres through each other",
      shapes::joined(shapes::icosphere(2), shapes::scaledAndShifted(shapes::icosphere(2), 1, {0.7, 0.1, 0})));
  checkAgainstBruteForce("doubled faces", shapes::joined(shapes::icosphere(1), shapes::soup(50, 4)));
}

TEST_CASE("few rays, many rays, narrow and wide cones are as brute force has them") {
  const Mesh mesh = shapes::jittered(shapes::icosphere(2), 0.05, 5);
  for (const ConeOptions& options :
       {ConeOptions{1, 120}, ConeOptions{2, 60}, ConeOptions{7, 10}, ConeOptions{300, 175}})
    checkAgainstBruteForce("sphere", mesh, 100, options);
  checkAgainstBruteForce("most rays", mesh, 4, {kMaxRayCount, 120});
  checkAgainstBruteForce("of CGAL", mesh, 200, kCgalCone);
  checkAgainstBruteForce("of CGAL, few rays", mesh, 200, {.rayCount = 4, .definition = Definition::Cgal});
  checkAgainstBruteForce("turned cones", mesh, 100, {.rotation = ConeRotation::Hashed});
}

TEST_CASE("values by CGAL's definition are as brute force has them") {
  checkAgainstBruteForce("dented sphere", shapes::jittered(shapes::icosphere(3), 0.05, 1), 400, kCgalCone);
  checkAgainstBruteForce("jittered box", shapes::jittered(shapes::box({1, 2, 3}, 6), 0.02, 2), 400, kCgalCone);
  checkAgainstBruteForce("cylinder", shapes::cylinder(1, 5, 25, 8), 400, kCgalCone);
  checkAgainstBruteForce("shell", shapes::shell(1, 0.7), 400, kCgalCone);
  checkAgainstBruteForce("open box", shapes::jittered(shapes::openBox({1, 1, 1}, 6), 0.02, 3), 400, kCgalCone);
  checkAgainstBruteForce("soup", shapes::soup(300, 3), 400, kCgalCone);
}

TEST_CASE("a wall has the value that CGAL's definition gives for parallel planes") {
  // Two squares, 1 apart and so wide that no ray leaves: length i is the root of 1 + 3 (i / 25)^2.
  const auto square = [](double z, bool isUp) {
    const double w = 50;
    Mesh mesh{{{-w, -w, z}, {w, -w, z}, {w, w, z}, {-w, w, z}}, {{0, 1, 2}, {0, 2, 3}}, {}};
    return isUp ? mesh : shapes::inverted(mesh);
  };
  const TracedMesh traced(shapes::joined(square(0, false), square(1, true)));
  std::vector<double> lengths;
  for (int i = 0; i < 25; ++i) lengths.push_back(std::sqrt(1 + 3 * std::pow(i / 25.0, 2)));
  // Ascending: the median is length 12, 1.30046. The median difference from it is that of length 17, 0.24460; one and a
  // half of it keep the lengths 0 to 19, from 1 to 1.654, up to 1.667.
  double sum = 0;
  for (int i = 0; i <= 19; ++i) sum += lengths[static_cast<size_t>(i)];
  for (const double value : traced.values(kCgalCone)) CHECK(value == doctest::Approx(sum / 20).epsilon(1e-13));
}

TEST_CASE("coordinates far from 1 and from the origin are as brute force has them") {
  const Mesh mesh = shapes::jittered(shapes::icosphere(2), 0.05, 6);
  checkAgainstBruteForce("millimetres", shapes::scaledAndShifted(mesh, 1e-3, {}));
  checkAgainstBruteForce("kilometres", shapes::scaledAndShifted(mesh, 1e3, {100, -2000, 50}));
}
