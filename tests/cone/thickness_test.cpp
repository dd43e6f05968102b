#include "cone/thickness.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/random.h"

using namespace asdfvk;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Vec3d kAxis{0, 0, 1};

WallTriangle wallOf(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d product = cross(b - a, c - a);
  return {a, b, c, product / length(product)};
}

/// Over a grid of points of the triangle.
double leastOfPoints(const Vec3d& axis, const WallTriangle& wall, int steps) {
  double least = kInfinity;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
      const Vec3d v = wall.a + s * (wall.b - wall.a) + t * (wall.c - wall.a);
      if (dot(v, axis) > 0) least = std::min(least, dot(v, v) / dot(v, axis));
    }
  return least;
}

}  // namespace

TEST_CASE("the least diameter is that of the points of the triangle") {
  Random random(7);
  const auto point = [&] { return Vec3d{random.real() - 0.5, random.real() - 0.5, random.real() - 0.5}; };
  int finiteCount = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d direction = point(), axis = direction / length(direction);
    const WallTriangle wall = wallOf(point(), point(), point());
    const double least = leastDiameter(axis, wall, kInfinity), expected = leastOfPoints(axis, wall, 100);
    if (std::isinf(expected)) continue;
    ++finiteCount;
    CAPTURE(i);
    CHECK(least <= expected * (1 + 1e-12));
    // The grid misses the least point by up to a hundredth of the size of the triangle.
    if (expected > 0.1) CHECK(least > expected * 0.98 - 0.02);
  }
  CHECK(finiteCount > 1000);
}

TEST_CASE("a wide parallel wall gives its distance, a tilted one the ball that touches its plane") {
  const WallTriangle parallel = wallOf({-9, -9, 2}, {9, -9, 2}, {0, 9, 2});
  CHECK(leastDiameter(kAxis, parallel, kInfinity) == doctest::Approx(2).epsilon(1e-15));
  // The plane z = 2 + x: at the distance 2 / sqrt 2 from the origin, at 45 degrees to the axis.
  const WallTriangle tilted = wallOf({-9, -9, -7}, {9, -9, 11}, {0, 9, 2});
  const double cosine = std::sqrt(0.5);
  CHECK(leastDiameter(kAxis, tilted, kInfinity) == doctest::Approx(2 * 2 * cosine / (1 + cosine)).epsilon(1e-14));
}

TEST_CASE("edges and corners of a wall count, points behind the face do not") {
  // The nearest point is the corner at (1, 0, 1): diameter 2.
  CHECK(leastDiameter(kAxis, wallOf({1, 0, 1}, {5, -1, 1}, {5, 1, 1}), kInfinity) == doctest::Approx(2));
  // The edge from (1, -1, 1) to (1, 1, 1).
  CHECK(leastDiameter(kAxis, wallOf({1, -1, 1}, {5, 0, 1}, {1, 1, 1}), kInfinity) == doctest::Approx(2));
  CHECK(std::isinf(leastDiameter(kAxis, wallOf({-1, -1, -1}, {1, -1, -1}, {0, 1, -1}), kInfinity)));
  CHECK(std::isinf(leastDiameter(kAxis, wallOf({1, -1, 0}, {3, -1, 0}, {2, 1, 0}), kInfinity)));
  // Partly behind: an upright wall at x = 1 from z = -1 to 1. Its plane touches the ball of radius 1 at z = 1.
  CHECK(leastDiameter(kAxis, wallOf({1, -5, -1}, {1, 5, -1}, {1, 0, 1}), kInfinity) == doctest::Approx(2));
}

TEST_CASE("a wall through the barycentre gives 0, and limits cut off") {
  CHECK(leastDiameter(kAxis, wallOf({-1, 0, -1}, {1, 0, -1}, {0, 0, 1}), kInfinity) == 0);
  CHECK(leastDiameter(kAxis, wallOf({0, 0, 0}, {1, 0, 1}, {0, 1, 1}), kInfinity) == 0);
  const WallTriangle wall = wallOf({-9, -9, 2}, {9, -9, 2}, {0, 9, 2});
  CHECK(std::isinf(leastDiameter(kAxis, wall, 2)));
  CHECK(leastDiameter(kAxis, wall, 2.001) == doctest::Approx(2));
}

TEST_CASE("walls oppose from the angle on, with a slack for rounding") {
  const OpposingWalls walls = makeOpposingWalls(120);
  const auto at = [](double degrees) {
    const double radians = degrees * std::acos(-1.0) / 180;
    return Vec3d{std::sin(radians), 0, std::cos(radians)};
  };
  CHECK(walls.contain(kAxis, at(180)));
  CHECK(walls.contain(kAxis, at(120)));
  CHECK_FALSE(walls.contain(kAxis, at(119)));
  CHECK_FALSE(walls.contain(kAxis, at(90)));
  CHECK(makeOpposingWalls(180).contain(kAxis, at(180)));
  for (const double wrong : {90.0, 180.5, 0.0, std::nan("")}) CHECK_THROWS_AS((void)makeOpposingWalls(wrong), Error);
}
