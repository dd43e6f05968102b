#include "pipeline/surface_points.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "asdf_vk/scene.h"
#include "core/random.h"
#include "generate/shapes.h"
#include "generate/thickness_parts.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "support/surface_points.h"

// Thickness and faces at points, through Scene.

using namespace asdfvk;
using test::barycentresOf;
using test::referenceSession;
using test::requireFailure;
using test::SurfacePoints;

namespace {

constexpr double kUnboundedThickness = std::numeric_limits<double>::infinity();

Options thicknessOptions(double wallAngle = 120) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.wallAngleDegrees = wallAngle;
  return options;
}

std::vector<double> fieldOf(const Result& result) { return *result.field("thickness")->reals(); }

/// Values that differ by more than rounding, and values on one side only.
size_t differingCount(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i)
    count += std::isnan(a[i]) != std::isnan(b[i]) || std::abs(a[i] - b[i]) > 1e-9 * std::abs(a[i]) ? 1 : 0;
  return count;
}

Mesh partMesh(const char* name) { return makeThicknessPart(name).solid.surface(); }

/// With a cavity.
Mesh hollowBox() { return shapes::joined(shapes::box({3, 4, 5}, 3), shapes::inverted(shapes::box({2, 2, 2}, 2))); }

double valueAt(Scene& scene, const Vec3d& point, const Vec3d& normal) {
  SurfacePoints one;
  one.add(point, normal);
  return scene.thicknessAt(one.points, one.normals).front();
}

}  // namespace

TEST_CASE("at barycentres the thickness of points is that of the faces") {
  for (const Mesh& mesh : {makeHand(800).mesh, partMesh("blade"), partMesh("pocket"), partMesh("thick-cube"),
                           shapes::jittered(shapes::openBox({1, 1, 2}, 4), 0.02, 3), hollowBox(),
                           shapes::joined(shapes::cube(), shapes::grid(3), {0, 0, 4})})
    for (const double wallAngle : {120.0, 150.0}) {
      CAPTURE(mesh.faces.size());
      CAPTURE(wallAngle);
      Scene scene(referenceSession(), mesh);
      const Options options = thicknessOptions(wallAngle);
      const std::vector<double> expected = fieldOf(scene.compute(options));
      const SurfacePoints points = barycentresOf(mesh);
      CHECK(differingCount(expected, scene.thicknessAt(points.points, points.normals, options.thickness)) == 0);
    }
}

TEST_CASE("on the thin wedge the thickness of points is that of the planes, on each wall and between barycentres") {
  // 60 long, 20 wide, 2 to 0.3 high.
  const Mesh mesh = partMesh("thin-wedge");
  Scene scene(referenceSession(), mesh);
  const double slope = 1.7 / 60;
  for (const double x : {5.0, 20.0, 45.0, 59.0}) {
    const double height = 2 - slope * x;
    CHECK(valueAt(scene, {x, 7, 0}, {0, 0, -3}) == doctest::Approx(2 * height / (1 + std::hypot(1, slope))));
    const double fromTop = 2 * height / (1 + 1 / std::hypot(1, slope));
    CHECK(valueAt(scene, {x, 7, height}, {slope, 0, 1}) == doctest::Approx(fromTop));
  }
}

TEST_CASE("in an open component a point that no wall opposes has no thickness, in a closed one the greatest section") {
  const Mesh open = shapes::openBox({2, 2, 3}, 2);
  Scene box(referenceSession(), open);
  CHECK(std::isnan(valueAt(box, {0.1, 0.2, -1.5}, {0, 0, -1})));
  CHECK(valueAt(box, {1, 0.2, 0.1}, {1, 0, 0}) == doctest::Approx(2));
  const Mesh closed = shapes::cube();
  Scene cube(referenceSession(), closed);
  SurfacePoints oblique;  // No wall is at 150 degrees to this normal.
  oblique.add({1, 0.3, 0.2}, {0.6, 0.6, 0.5});
  const double greatest = cube.compute(thicknessOptions()).report.thickness->greatestSection->diameter;
  CHECK(cube.thicknessAt(oblique.points, oblique.normals, {.wallAngleDegrees = 150}).front() == greatest);
  CHECK(cube.thicknessAt(oblique.points, oblique.normals).front() < 0.9 * greatest);
}

TEST_CASE("points far from the mesh have no thickness") {
  const Mesh mesh = shapes::cube();
  Scene scene(referenceSession(), mesh);
  CHECK(std::isnan(valueAt(scene, {9, 0, 0}, {1, 0, 0})));
  CHECK(std::isnan(valueAt(scene, {1e200, 0, 0}, {1, 0, 0})));
  CHECK(valueAt(scene, {1, 0, 0}, {1e-200, 0, 0}) == doctest::Approx(2));
}

TEST_CASE("a flipped scene has the thickness of the mesh that it flips to") {
  for (const Mesh& mesh : {partMesh("blade"), makeHand(800).mesh, hollowBox()}) {
    const Mesh inverted = shapes::inverted(mesh);
    Scene scene(referenceSession(), mesh), flipped(referenceSession(), inverted, Orientation::Flip);
    const SurfacePoints points = barycentresOf(mesh);
    const std::vector<double> expected = scene.thicknessAt(points.points, points.normals);
    CHECK(differingCount(expected, flipped.thicknessAt(points.points, points.normals)) == 0);
    CHECK(std::none_of(expected.begin(), expected.end(), [](double value) { return std::isnan(value); }));
    Options options = thicknessOptions();
    options.orientation = Orientation::Flip;
    CHECK(differingCount(expected, fieldOf(flipped.compute(options))) == 0);
  }
}

TEST_CASE("a point has the same thickness alone, among others, and in another order") {
  const Mesh mesh = makeHand(800).mesh;
  Scene scene(referenceSession(), mesh);
  const SurfacePoints points = barycentresOf(mesh);
  const std::vector<double> together = scene.thicknessAt(points.points, points.normals);
  SurfacePoints reversed;
  const auto at = [](const std::vector<double>& numbers, size_t i) {
    return Vec3d{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  };
  for (size_t i = together.size(); i-- > 0;) reversed.add(at(points.points, i), at(points.normals, i));
  std::vector<double> values = scene.thicknessAt(reversed.points, reversed.normals);
  std::reverse(values.begin(), values.end());
  CHECK(test::haveSameBits(values, together));
  CHECK(valueAt(scene, at(points.points, 11), at(points.normals, 11)) == together[11]);
  CHECK(scene.thicknessAt({}, {}).empty());
}

TEST_CASE("the nearest faces are input faces, also of polygons, the first of equally near ones") {
  // A box of six quads: each face of the cube is two triangles.
  const std::vector<double> positions{0, 0, 0, 4, 0, 0, 4, 2, 0, 0, 2, 0, 0, 0, 1, 4, 0, 1, 4, 2, 1, 0, 2, 1};
  const std::vector<uint32_t> corners{3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 1, 2, 6, 5, 3, 0, 4, 7};
  const std::vector<uint64_t> firstCorner{0, 4, 8, 12, 16, 20, 24};
  Scene box(referenceSession(), MeshView(positions, corners, firstCorner));
  const std::vector<double> points{2, 1, -9, 1, 0.5, 1.3, 2, -0.1, 0.5, 3, 2.2, 0.4, 4.1, 1.2, 0.6, -1, 0.7, 0.5};
  CHECK(box.nearestFaces(points) == std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  // Each barycentre of a mesh is nearest to its own face.
  const Mesh torus = makeTorus(1500).mesh;
  Scene scene(referenceSession(), torus);
  const std::vector<uint32_t> own = scene.nearestFaces(barycentresOf(torus).points);
  for (uint32_t face = 0; face < own.size(); ++face) CHECK(own[face] == face);
  // A degenerate face is never the nearest one. If faces coincide, only the first of them counts.
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 2}, {2, 1, 0}}, {}};
  Scene copies(referenceSession(), mesh);
  CHECK(copies.nearestFaces(std::vector<double>{0.1, 0, 0, 0.1, 0.1, -5}) == std::vector<uint32_t>{1, 1});
}

TEST_CASE("invalid points, normals and angles throw") {
  const Mesh mesh = shapes::sphere(2);
  Scene scene(referenceSession(), mesh);
  const std::vector<double> good(9, 0.5);
  for (const double bad : {std::nan(""), kUnboundedThickness}) {
    std::vector<double> wrong = good;
    wrong[7] = bad;
    requireFailure([&] { (void)scene.thicknessAt(wrong, good); }, ErrorCode::NonFiniteNumber, "point 2 has");
    requireFailure([&] { (void)scene.thicknessAt(good, wrong); }, ErrorCode::NonFiniteNumber, "point 2 has");
    requireFailure([&] { (void)scene.nearestFaces(wrong); }, ErrorCode::NonFiniteNumber, "point 2 has");
  }
  std::vector<double> normals = good;
  std::fill_n(normals.begin() + 3, 3, 0.0);
  requireFailure([&] { (void)scene.thicknessAt(good, normals); }, ErrorCode::OptionOutOfRange);
  requireFailure([&] { (void)scene.thicknessAt(good, std::span(good).first(6)); }, ErrorCode::ArraySize);
  requireFailure([&] { (void)scene.nearestFaces(std::span(good).first(4)); }, ErrorCode::ArraySize);
  for (const double angle : {90.0, 181.0})
    requireFailure([&] { (void)scene.thicknessAt(good, good, {.wallAngleDegrees = angle}); },
                   ErrorCode::OptionOutOfRange, "is not a number above 90");
  std::stop_source stop;
  stop.request_stop();
  requireFailure([&] { (void)scene.thicknessAt(good, good, {}, {stop.get_token(), {}}); }, ErrorCode::Cancelled);
  requireFailure([&] { (void)scene.nearestFaces(good, {stop.get_token(), {}}); }, ErrorCode::Cancelled);
  const Mesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}};
  Scene none(referenceSession(), line);
  requireFailure([&] { (void)none.nearestFaces(good); }, ErrorCode::NoValues);
  for (const double value : none.thicknessAt(good, good)) CHECK(std::isnan(value));
}
