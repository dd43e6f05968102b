#include "cone/touching_ball.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace asdfvk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double diameterThrough(const Vec3d& v, const Vec3d& axis) {
  const double depth = dot(v, axis);
  return depth > 0 ? dot(v, v) / depth : kInfinity;
}

/// The t in [0, 1] with the least diameter through a + t edge. With A = a . axis, B = edge . axis, C = |a|^2,
/// D = a . edge and E = |edge|^2 the diameter is stationary where B E t^2 + 2 A E t = B C - 2 A D; the greater of both
/// roots by depth is the minimum. Precondition: both ends are deeper than 0.
double leastOnEdge(const Vec3d& axis, const Vec3d& a, const Vec3d& edge) {
  const double depth = dot(a, axis), slope = dot(edge, axis), square = dot(edge, edge);
  const double root = std::sqrt(square) * length(depth * edge - slope * a);
  const double t = (slope * dot(a, a) - 2 * depth * dot(a, edge)) / (depth * square + root);
  return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0;
}

/// The part of a triangle below a depth: up to four corners.
class DeepPart {
 public:
  DeepPart(const PlaneTriangle& wall, const Vec3d& origin, const Vec3d& axis, double minDepth) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d &a = wall.corners[k], &b = wall.corners[(k + 1) % 3];
      const double above = dot(a - origin, axis) - minDepth, next = dot(b - origin, axis) - minDepth;
      if (above > 0) corners_[count_++] = a;
      if ((above > 0) != (next > 0)) corners_[count_++] = a + above / (above - next) * (b - a);
    }
  }

  [[nodiscard]] std::span<const Vec3d> corners() const { return {corners_.data(), count_}; }
  template <typename Visit>
  void forEachEdge(const Visit& visit) const {
    for (size_t k = 0; k < count_; ++k) visit(corners_[k], corners_[(k + 1) % count_]);
  }

 private:
  std::array<Vec3d, 4> corners_;
  size_t count_ = 0;
};

/// The nearest point of a triangle to a point of its plane.
Vec3d nearestInPlane(const PlaneTriangle& triangle, const Vec3d& p) {
  bool isInside = true;
  double least = kInfinity;
  Vec3d nearest = p;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d &a = triangle.corners[k], edge = triangle.corners[(k + 1) % 3] - a;
    if (dot(cross(edge, p - a), triangle.normal) >= 0) continue;
    isInside = false;
    const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
    const Vec3d candidate = a + t * edge;
    const double square = dot(p - candidate, p - candidate);
    if (square >= least) continue;
    least = square;
    nearest = candidate;
  }
  return isInside ? p : nearest;
}

/// Collects the least of the cases.
class LeastBall {
 public:
  LeastBall(const PlaneTriangle& wall, const Vec3d& axis, const DeepPart& part)
      : wall_(wall), axis_(axis), part_(part) {}

  void offer(const Vec3d& p, const Vec3d& q) {
    const double diameter = diameterThrough(q - p, axis_);
    if (diameter < best_.diameter) best_ = {diameter, p, q};
  }

  /// The ball at a point of the face against the interior and the edges of the wall.
  void offerPoint(const Vec3d& p) {
    const double offset = dot(wall_.normal, part_.corners().front() - p);
    const double side = offset < 0 ? -1 : 1, radius = std::abs(offset) / (1 + side * dot(wall_.normal, axis_));
    const Vec3d touched = p + radius * (axis_ + side * wall_.normal);
    bool isInside = std::isfinite(radius);
    part_.forEachEdge([&](const Vec3d& a, const Vec3d& b) {
      isInside = isInside && dot(cross(b - a, touched - a), wall_.normal) >= 0;
      offer(p, a + leastOnEdge(axis_, a - p, b - a) * (b - a));
    });
    if (isInside) offer(p, touched);
  }

  /// The balls on an edge of the face against the edges of the wall: in the projection along the edge of the face.
  void offerEdge(const Vec3d& from, const Vec3d& to) {
    const Vec3d edge = to - from;
    const double square = dot(edge, edge);
    if (square == 0) return;
    part_.forEachEdge([&](const Vec3d& a, const Vec3d& b) {
      const auto across = [&](const Vec3d& v) { return v - dot(v, edge) / square * edge; };
      const Vec3d q = a + leastOnEdge(axis_, across(a - from), across(b - a)) * (b - a);
      const double s = dot(q - from, edge) / square;
      if (s >= 0 && s <= 1) offer(from + s * edge, q);
    });
  }

  [[nodiscard]] TouchingBall below(double limit) const { return best_.diameter < limit ? best_ : TouchingBall{}; }

 private:
  const PlaneTriangle& wall_;
  Vec3d axis_;
  const DeepPart& part_;
  TouchingBall best_;
};

}  // namespace

TouchingBall leastTouchingBall(const PlaneTriangle& face, const PlaneTriangle& wall, double minDepth, double limit) {
  const Vec3d axis = -face.normal;
  const DeepPart part(wall, face.corners[0], axis, minDepth);
  if (part.corners().empty()) return {};
  LeastBall least(wall, axis, part);
  for (const Vec3d& q : part.corners()) least.offer(nearestInPlane(face, q - dot(q - face.corners[0], axis) * axis), q);
  for (size_t k = 0; k < 3; ++k) {
    least.offerPoint(face.corners[k]);
    least.offerEdge(face.corners[k], face.corners[(k + 1) % 3]);
  }
  return least.below(limit);
}

TouchingBall leastTouchingBall(const Vec3d& point, const Vec3d& faceNormal, const PlaneTriangle& wall, double minDepth,
                               double limit) {
  const Vec3d axis = -faceNormal;
  const DeepPart part(wall, point, axis, minDepth);
  if (part.corners().empty()) return {};
  LeastBall least(wall, axis, part);
  least.offerPoint(point);
  return least.below(limit);
}

}  // namespace asdfvk
