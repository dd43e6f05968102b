#include "render/camera.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"

namespace asdfvk {
namespace {

/// The corners of the box between two points.
std::vector<Vec3d> boxCorners(const Vec3d& low, const Vec3d& high) {
  std::vector<Vec3d> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  return corners;
}

bool isNear(const Vec3d& a, const Vec3d& b) { return length(a - b) < 1e-12; }

TEST_CASE("the camera's directions are a right-handed frame, whatever is up") {
  const std::vector<Vec3d> points = boxCorners({-1, -2, -3}, {1, 2, 3});
  for (const Up up : {Up::X, Up::Y, Up::Z, Up::MinusX, Up::MinusY, Up::MinusZ})
    for (const double elevation : {-90.0, 0.0, 35.0}) {
      const Camera camera = frameCamera(points, {up, 77, elevation}, {0, 0, 100, 100});
      CHECK(isNear(cross(camera.right, camera.up), camera.toViewer));
      CHECK_EQ(length(camera.right), doctest::Approx(1));
      CHECK_EQ(dot(camera.toViewer, directionOf(up)), doctest::Approx(std::sin(elevation * 3.141592653589793 / 180)));
      CHECK_EQ(dot(camera.right, directionOf(up)), doctest::Approx(0));
      CHECK_GE(dot(camera.up, directionOf(up)), -1e-12);
    }
}

TEST_CASE("without angles the broad side is seen from the usual front") {
  const PixelArea area{0, 0, 100, 100};
  const auto front = [&](const Vec3d& size, Up up) {
    return frameCamera(boxCorners({}, size), {up, 0, 0}, area).toViewer;
  };
  CHECK(isNear(front({3, 1, 2}, Up::Y), {0, 0, 1}));
  CHECK(isNear(front({2, 1, 3}, Up::Y), {1, 0, 0}));
  CHECK(isNear(front({2, 1, 2}, Up::Y), {0, 0, 1}));
  CHECK(isNear(front({3, 2, 1}, Up::Z), {0, -1, 0}));
  CHECK(isNear(front({2, 3, 1}, Up::Z), {1, 0, 0}));
  CHECK(isNear(front({1, 3, 2}, Up::X), {0, 0, 1}));
}

TEST_CASE("a positive azimuth moves the viewer to the right") {
  const std::vector<Vec3d> points = boxCorners({}, {1, 1, 1});
  const Camera front = frameCamera(points, {Up::Y, 0, 0}, {0, 0, 100, 100});
  const Camera aside = frameCamera(points, {Up::Y, 30, 0}, {0, 0, 100, 100});
  CHECK_EQ(dot(aside.toViewer, front.right), doctest::Approx(0.5));
}

TEST_CASE("points just fill the area, centred") {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 50; ++i) points.push_back({random.real() * 3 + 7, random.real(), random.real() * 5});
    const PixelArea area{10, 20, 300, 200};
    const Camera camera = frameCamera(points, {Up::Y, random.real() * 360, random.real() * 180 - 90}, area);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const Vec3d& point : points) {
      const double x = camera.centreX + dot(point - camera.centre, camera.right) / camera.pixelSize;
      const double y = camera.centreY - dot(point - camera.centre, camera.up) / camera.pixelSize;
      CHECK(length(cross(camera.pointAt(x, y) - point, camera.toViewer)) < 1e-9);
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
    CHECK_EQ(left - 10, doctest::Approx(310 - right));
    CHECK_EQ(top - 20, doctest::Approx(220 - bottom));
    CHECK_EQ(std::min(left - 10, top - 20), doctest::Approx(0).epsilon(1e-9));
  }
}

TEST_CASE("an empty scene has a camera") {
  const std::vector<Vec3d> one{{5, 5, 5}};
  for (const std::span<const Vec3d> points : {std::span<const Vec3d>(), std::span<const Vec3d>(one)}) {
    const Camera camera = frameCamera(points, {}, {0, 0, 100, 50});
    CHECK_EQ(camera.pixelSize, doctest::Approx(0.02));
    CHECK(isFinite(camera.pointAt(3, 4)));
  }
}

/// Four legs under a plate, standing along the axis, turned over for a negative `sign`.
std::vector<Vec3d> table(size_t axis, double sign) {
  std::vector<Vec3d> points = boxCorners({-1.2, 0.9, -0.8}, {1.2, 1, 0.8});
  for (const double x : {-0.9, 0.9})
    for (const double z : {-0.5, 0.5})
      for (const Vec3d& corner : boxCorners({x - 0.05, 0, z - 0.05}, {x + 0.05, 0.9, z + 0.05}))
        points.push_back(corner);
  for (Vec3d& p : points) {
    Vec3d turned;
    turned[axis] = sign * p.y;
    turned[(axis + 1) % 3] = p.x;
    turned[(axis + 2) % 3] = p.z;
    p = turned;
  }
  return points;
}

TEST_CASE("points are stable if their mean is above the hull of the lowest ones") {
  CHECK_EQ(standingShare(boxCorners({}, {1, 2, 3}), Up::Z), doctest::Approx(1));
  CHECK_EQ(standingShare(table(1, 1), Up::Y), doctest::Approx(1.9 * 1.1 / (2.4 * 1.6)));
  std::vector<Vec3d> overhang = boxCorners({0, 0, 0}, {1, 1, 1});
  for (const Vec3d& corner : boxCorners({3, 2, 0}, {9, 3, 1})) overhang.push_back(corner);
  CHECK_EQ(standingShare(overhang, Up::Y), doctest::Approx(-1.0 / 9));
  CHECK_EQ(standingShare(std::vector<Vec3d>{{0, 0, 0}, {1, 5, 1}}, Up::Y), 0);
  CHECK_EQ(standingShare({}, Up::Y), 0);
}

TEST_CASE("the up direction is the usual one unless the points are unstable") {
  CHECK(guessUp(boxCorners({}, {1, 1, 1})) == Up::Y);
  CHECK(guessUp({}) == Up::Y);
  CHECK(guessUp(table(1, 1)) == Up::Y);
  CHECK(guessUp(table(2, 1)) == Up::Z);
  CHECK(guessUp(table(0, 1)) == Up::X);
  CHECK(guessUp(table(1, -1)) == Up::Y);  // Stable on its top.
  CHECK(guessUp(boxCorners({}, {1, 1, 1}), Up::Z) == Up::Z);
  CHECK(guessUp({}, Up::Z) == Up::Z);
  CHECK(guessUp(table(2, 1), Up::Z) == Up::Z);
  CHECK(guessUp(table(0, 1), Up::Z) == Up::X);
  // // Stable in no direction: a spear on its tip.
  CHECK(guessUp(std::vector<Vec3d>{{0, 0, 0}, {0.5, 3, 0}, {-0.2, 3.5, 0.4}, {0.7, 4, -0.4}}) == Up::Y);
}

}  // namespace
}  // namespace asdfvk
