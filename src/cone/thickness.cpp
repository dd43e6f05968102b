#include "cone/thickness.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "asdf_vk/error.h"
#include "shared/cone_rules.h"

namespace asdfvk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double diameterThrough(const Vec3d& axis, const Vec3d& v) {
  const double square = dot(v, v), height = dot(v, axis);
  if (square == 0) return 0;
  return height > 0 ? square / height : kInfinity;
}

/// Over the points a + t edge, 0 <= t <= 1. With A = a . axis, B = edge . axis, C = |a|^2, D = a . edge and
/// E = |edge|^2 the diameter is stationary where B E t^2 + 2 A E t = B C - 2 A D; the greater of both roots by height
/// is the minimum.
double leastOnEdge(const Vec3d& axis, const Vec3d& a, const Vec3d& b) {
  const Vec3d edge = b - a;
  const double height = dot(a, axis), slope = dot(edge, axis), square = dot(edge, edge);
  const double root = std::sqrt(square) * length(height * edge - slope * a);
  const double t = height >= 0 ? (slope * dot(a, a) - 2 * height * dot(a, edge)) / (height * square + root)
                               : (root - height * square) / (slope * square);
  return diameterThrough(axis, std::isfinite(t) ? a + std::clamp(t, 0.0, 1.0) * edge : a);
}

}  // namespace

OpposingWalls makeOpposingWalls(double angleDegrees) {
  if (!(angleDegrees > 90 && angleDegrees <= 180))
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("an angle of {} degrees between opposing walls is out of range; give more than 90 and at "
                            "most 180",
                            angleDegrees));
  return {std::cos(angleDegrees * std::numbers::pi / 180) + static_cast<double>(kOpposingWallSlack)};
}

double leastDiameter(const Vec3d& axis, const WallTriangle& wall, double limit) {
  const double offset = dot(wall.normal, wall.a), diameter = planeDiameter(axis, wall.normal, offset);
  if (diameter >= limit) return kInfinity;
  const bool hasPoint = std::isfinite(diameter);
  const Vec3d point = 0.5 * diameter * (offset < 0 ? axis - wall.normal : axis + wall.normal);
  bool isInside = hasPoint;
  double least = kInfinity;
  // Balls that touch the plane all contain the point at which the least of them touches it. If this point is outside of
  // the triangle, the least diameter over the triangle is on an edge that faces the point.
  const auto visitEdge = [&](const Vec3d& from, const Vec3d& to) {
    if (hasPoint && dot(cross(to - from, point - from), wall.normal) >= 0) return;
    isInside = false;
    least = std::min(least, leastOnEdge(axis, from, to));
  };
  visitEdge(wall.a, wall.b);
  visitEdge(wall.b, wall.c);
  visitEdge(wall.c, wall.a);
  if (isInside) return diameter;
  return least < limit ? least : kInfinity;
}

}  // namespace asdfvk
