#include "cone/touching_ball.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

using namespace asdfvk;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMinDepth = 1e-7;

PlaneTriangle triangleOf(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d product = cross(b - a, c - a);
  return {{a, b, c}, product / length(product)};
}

Vec3d at(const PlaneTriangle& triangle, double s, double t) {
  const auto& [a, b, c] = triangle.corners;
  return a + s * (b - a) + t * (c - a);
}

/// Coordinates s and t of the least valueAt(s, t) in a triangle, for a function whose sublevel sets are convex: grids
/// that shrink around their least point.
template <typename ValueAt>
double leastInTriangle(const ValueAt& valueAt) {
  constexpr int kSteps = 8;
  double centreS = 1.0 / 3, centreT = 1.0 / 3, width = 1, least = kInfinity;
  for (int round = 0; round < 45; ++round, width *= 0.5) {
    double bestS = centreS, bestT = centreT;
    for (int i = -kSteps; i <= kSteps; ++i)
      for (int j = -kSteps; j <= kSteps; ++j) {
        double s = std::clamp(centreS + width * i / kSteps, 0.0, 1.0);
        double t = std::clamp(centreT + width * j / kSteps, 0.0, 1.0);
        if (s + t > 1) {  // To the edge opposite of corner a.
          const double excess = 0.5 * (s + t - 1);
          s = std::clamp(s - excess, 0.0, 1.0);
          t = 1 - s;
        }
        const double value = valueAt(s, t);
        if (value >= least) continue;
        least = value;
        bestS = s;
        bestT = t;
      }
    centreS = bestS;
    centreT = bestT;
  }
  return least;
}

double diameterOf(const Vec3d& p, const Vec3d& q, const Vec3d& axis) {
  const double depth = dot(q - p, axis);
  return depth > kMinDepth ? dot(q - p, q - p) / depth : kInfinity;
}

/// By grids over the wall, and the point of the face that is nearest to each of its points.
double twinOfFace(const PlaneTriangle& face, const PlaneTriangle& wall) {
  return leastInTriangle([&](double s, double t) {
    const Vec3d q = at(wall, s, t), axis = -face.normal;
    const double depth = dot(q - face.corners[0], axis);
    if (depth <= kMinDepth) return kInfinity;
    // |q - p|^2 = depth^2 + |q' - p|^2 with the projection q' of q.
    const Vec3d projected = q - depth * axis;
    double nearest = kInfinity;
    bool isInside = true;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d &a = face.corners[k], &b = face.corners[(k + 1) % 3];
      isInside = isInside && dot(cross(b - a, projected - a), face.normal) >= 0;
      const double u = std::clamp(dot(projected - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
      nearest = std::min(nearest, length(a + u * (b - a) - projected));
    }
    return depth + (isInside ? 0 : nearest * nearest) / depth;
  });
}

double twinOfPoint(const Vec3d& p, const Vec3d& axis, const PlaneTriangle& wall) {
  return leastInTriangle([&](double s, double t) { return diameterOf(p, at(wall, s, t), axis); });
}

/// Coordinates of a point of the plane of a triangle are within [-slack, 1 + slack].
bool holds(const PlaneTriangle& triangle, const Vec3d& p) {
  const auto& [a, b, c] = triangle.corners;
  const double area = dot(cross(b - a, c - a), triangle.normal);
  for (const double part : {dot(cross(b - a, p - a), triangle.normal), dot(cross(c - b, p - b), triangle.normal),
                            dot(cross(a - c, p - c), triangle.normal)})
    if (part < -1e-9 * (1 + area)) return false;
  return std::abs(dot(p - a, triangle.normal)) < 1e-9;
}

}  // namespace

TEST_CASE("the least ball of a face against a wall is that of grids over both") {
  Random random(11);
  const auto point = [&](double depth) {
    return Vec3d{random.real() - 0.5, random.real() - 0.5, random.real() - 0.5 + depth};
  };
  int comparedCount = 0, crossingCount = 0;
  for (int i = 0; i < 120; ++i) {
    CAPTURE(i);
    const PlaneTriangle face = triangleOf(point(0), point(0), point(0));
    // Every third wall is near, so that most of these cross the plane of the face.
    const double distance = i % 3 == 0 ? 0.2 : 1.2;
    const Vec3d shift = -distance * face.normal;
    const PlaneTriangle wall = triangleOf(point(0) + shift, point(0) + shift, point(0) + shift);
    const double expected = twinOfFace(face, wall);
    const TouchingBall ball = leastTouchingBall(face, wall, kMinDepth, kInfinity);
    CHECK(std::isinf(ball.diameter) == std::isinf(expected));
    if (!std::isfinite(expected)) continue;
    const bool isCrossing = std::any_of(wall.corners.begin(), wall.corners.end(), [&](const Vec3d& q) {
      return dot(q - face.corners[0], -face.normal) < kMinDepth;
    });
    crossingCount += isCrossing ? 1 : 0;
    ++comparedCount;
    CHECK(ball.diameter <= expected * (1 + 1e-9));
    CHECK(ball.diameter >= expected * (1 - 1e-6) - 1e-6);
    const Vec3d v = ball.onWall - ball.onFace;
    CHECK(dot(v, v) / dot(v, -face.normal) == doctest::Approx(ball.diameter).epsilon(1e-6));
    CHECK(holds(face, ball.onFace));
    CHECK(holds(wall, ball.onWall));
    CHECK(leastTouchingBall(face, wall, kMinDepth, ball.diameter).diameter == ball.diameter);
    CHECK(leastTouchingBall(face, wall, kMinDepth, 0.9 * ball.diameter).diameter >= ball.diameter);
  }
  CHECK(comparedCount > 90);
  CHECK(crossingCount > 10);
}

TEST_CASE("the least ball of a point against a wall is that of a grid over the wall") {
  Random random(12);
  const auto point = [&] { return Vec3d{random.real() - 0.5, random.real() - 0.5, random.real() - 0.5}; };
  int comparedCount = 0;
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Vec3d direction = point(), axis = direction / length(direction), p = point() - 0.6 * axis;
    const PlaneTriangle wall = triangleOf(point(), point(), point());
    const double expected = twinOfPoint(p, axis, wall);
    const TouchingBall ball = leastTouchingBall(p, -axis, wall, kMinDepth, kInfinity);
    CHECK(std::isinf(ball.diameter) == std::isinf(expected));
    if (!std::isfinite(expected)) continue;
    ++comparedCount;
    CHECK(ball.diameter <= expected * (1 + 1e-9));
    CHECK(ball.diameter >= expected * (1 - 1e-6) - 1e-6);
    CHECK(ball.onFace.x == p.x);
    CHECK(holds(wall, ball.onWall));
  }
  CHECK(comparedCount > 150);
}

TEST_CASE("a wedge is thinnest at its narrow end") {
  // A face at z = 0 with its inside below, and a wall below it that is 3 deep at x = 0 and 1 deep at x = 10.
  const PlaneTriangle face = triangleOf({0, -5, 0}, {10, -5, 0}, {10, 5, 0});
  const PlaneTriangle wall = triangleOf({0, -5, -3}, {10, 5, -1}, {10, -5, -1});
  const TouchingBall ball = leastTouchingBall(face, wall, kMinDepth, kInfinity);
  // The ball that touches the plane of the wall does so beyond the wall, so the least one is as wide as the wedge.
  CHECK(ball.diameter == doctest::Approx(1).epsilon(1e-12));
  CHECK(ball.onFace.x == doctest::Approx(10));
}

TEST_CASE("parts of a wall that are not deep enough do not count") {
  const PlaneTriangle face = triangleOf({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  CHECK(std::isinf(
      leastTouchingBall(face, triangleOf({-1, -1, 1}, {0, 1, 1}, {1, -1, 1}), kMinDepth, kInfinity).diameter));
  CHECK(std::isinf(
      leastTouchingBall(face, triangleOf({-1, -1, 0}, {0, 1, 0}, {1, -1, 0}), kMinDepth, kInfinity).diameter));
  // A wall through the face begins at the least depth.
  const PlaneTriangle crossing = triangleOf({-0.1, 0, 0.5}, {0.1, 0, 0.5}, {0, 0, -0.5});
  CHECK(leastTouchingBall(face, crossing, 1e-3, kInfinity).diameter == doctest::Approx(1e-3).epsilon(1e-9));
}
