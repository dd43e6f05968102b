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

/// Returns the t in [0, 1] for which the ball through a + t edge has the least diameter. Let A = a . axis, B = edge .
/// axis, C = |a|^2, D = a . edge and E = |edge|^2. The diameter is stationary where B E t^2 + 2 A E t = B C - 2 A D.
/// The root with the greater depth is the minimum. Precondition: both ends have a depth above 0.
double leastOnEdge(const Vec3d& axis, const Vec3d& a, const Vec3d& edge) {
  const double depth = dot(a, axis), slope = dot(edge, axis), square = dot(edge, edge);
  const Vec3d turned = depth * edge - slope * a;
  const double root = std::sqrt(square * dot(turned, turned));
  const double t = (slope * dot(a, a) - 2 * depth * dot(a, edge)) / (depth * square + root);
  return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0;
}

/// Adds a margin for rounding. Lower bounds are compared with this number, so that walls in any order give the same
/// bits.
double withRounding(double diameter) { return diameter * (1 + 1e-9); }

/// A diameter is taken as the least depth of the wall if it is larger by less than this share.
constexpr double kDepthRounding = 1e-14;

/// The part of a triangle that is deeper than minDepth: up to four corners with their depths.
class DeepPart {
 public:
  DeepPart(const PlaneTriangle& wall, const Vec3d& origin, const Vec3d& axis, double minDepth) {
    std::array<double, 3> depths;
    for (size_t k = 0; k < 3; ++k) depths[k] = dot(wall.corners[k] - origin, axis);
    for (size_t k = 0; k < 3; ++k) {
      const size_t next = (k + 1) % 3;
      const double above = depths[k] - minDepth, nextAbove = depths[next] - minDepth;
      if (above > 0) add(wall.corners[k], depths[k]);
      if ((above > 0) != (nextAbove > 0)) {
        const Vec3d& a = wall.corners[k];
        add(a + above / (above - nextAbove) * (wall.corners[next] - a), minDepth);
      }
    }
  }

  [[nodiscard]] std::span<const Vec3d> corners() const { return {corners_.data(), count_}; }
  [[nodiscard]] double depth(size_t corner) const { return depths_[corner]; }
  [[nodiscard]] double leastDepth() const { return *std::min_element(depths_.begin(), depths_.begin() + count_); }
  /// Calls visit(a, b) for the edges with a point of depth at most maxDepth.
  template <typename Visit>
  void forEachEdge(double maxDepth, const Visit& visit) const {
    for (size_t k = 0; k < count_; ++k) {
      const size_t next = k + 1 == count_ ? 0 : k + 1;
      if (std::min(depths_[k], depths_[next]) <= maxDepth) visit(corners_[k], corners_[next]);
    }
  }

 private:
  void add(const Vec3d& corner, double depth) {
    corners_[count_] = corner;
    depths_[count_++] = depth;
  }

  std::array<Vec3d, 4> corners_;
  std::array<double, 4> depths_;
  size_t count_ = 0;
};

/// The point of a triangle nearest to a point in the plane of the triangle.
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

/// Keeps the least ball of all cases. The diameter of a ball is at least the depth of its point on the wall.
class LeastBall {
 public:
  LeastBall(const PlaneTriangle& wall, const Vec3d& axis, const DeepPart& part, double limit)
      : wall_(wall), axis_(axis), part_(part), limit_(withRounding(limit)), leastDepth_(part.leastDepth()) {}

  /// Whether the diameter is equal to the least depth of the wall. No ball is smaller than this depth.
  [[nodiscard]] bool isLeast() const { return best_.diameter == leastDepth_; }
  [[nodiscard]] bool mayImprove(double bound) const { return !(bound > limit_); }

  /// For a point p of the face, boundAt(offsetOf(p)) is the diameter of the ball at p that touches the plane of the
  /// wall. This diameter is a lower bound for balls at p that touch the wall.
  [[nodiscard]] double offsetOf(const Vec3d& p) const { return dot(wall_.normal, part_.corners().front() - p); }
  [[nodiscard]] double boundAt(double offset) const { return planeDiameter(axis_, wall_.normal, offset); }

  void offer(const Vec3d& p, const Vec3d& q) {
    const double diameter = diameterThrough(q - p, axis_);
    if (!(diameter < best_.diameter)) return;
    best_ = {diameter < leastDepth_ * (1 + kDepthRounding) ? leastDepth_ : diameter, p, q};
    limit_ = std::min(limit_, withRounding(diameter));
  }

  /// The least ball at a point of the face. The diameter is a convex function of the point of the wall. Therefore, if
  /// the ball touches the plane of the wall outside of the wall, the least ball touches an edge whose outer side has
  /// this place.
  void offerPoint(const Vec3d& p, double offset) {
    const double side = offset < 0 ? -1 : 1, radius = std::abs(offset) / (1 + side * dot(wall_.normal, axis_));
    const Vec3d touched = p + radius * (axis_ + side * wall_.normal);
    bool isInside = std::isfinite(radius);
    const bool hasPlace = isInside;
    part_.forEachEdge(kInfinity, [&](const Vec3d& a, const Vec3d& b) {
      if (hasPlace && dot(cross(b - a, touched - a), wall_.normal) >= 0) return;
      isInside = false;
      offer(p, a + leastOnEdge(axis_, a - p, b - a) * (b - a));
    });
    if (isInside) offer(p, touched);
  }

  /// The balls that touch an edge of the face and an edge of the wall, computed in the projection along the first edge.
  void offerEdge(const Vec3d& from, const Vec3d& to) {
    const Vec3d edge = to - from;
    const double square = dot(edge, edge);
    if (square == 0) return;
    part_.forEachEdge(limit_, [&](const Vec3d& a, const Vec3d& b) {
      const auto across = [&](const Vec3d& v) { return v - dot(v, edge) / square * edge; };
      const Vec3d q = a + leastOnEdge(axis_, across(a - from), across(b - a)) * (b - a);
      const double s = dot(q - from, edge) / square;
      if (s >= 0 && s <= 1) offer(from + s * edge, q);
    });
  }

  [[nodiscard]] const TouchingBall& ball() const { return best_; }

 private:
  const PlaneTriangle& wall_;
  Vec3d axis_;
  const DeepPart& part_;
  TouchingBall best_;
  double limit_, leastDepth_;
};

}  // namespace

TouchingBall leastTouchingBall(const PlaneTriangle& face, const PlaneTriangle& wall, double minDepth, double limit) {
  const Vec3d axis = -face.normal;
  const DeepPart part(wall, face.corners[0], axis, minDepth);
  const std::span<const Vec3d> corners = part.corners();
  if (corners.empty() || part.leastDepth() > withRounding(limit)) return {};
  LeastBall least(wall, axis, part, limit);
  std::array<double, 3> offsets, bounds;
  for (size_t k = 0; k < 3; ++k) {
    offsets[k] = least.offsetOf(face.corners[k]);
    bounds[k] = least.boundAt(offsets[k]);
  }
  for (size_t k = 0; k < corners.size() && !least.isLeast(); ++k)
    if (least.mayImprove(part.depth(k)))
      least.offer(nearestInPlane(face, corners[k] - part.depth(k) * axis), corners[k]);
  for (size_t k = 0; k < 3 && !least.isLeast(); ++k)
    if (least.mayImprove(bounds[k])) least.offerPoint(face.corners[k], offsets[k]);
  for (size_t k = 0; k < 3 && !least.isLeast(); ++k) {
    const size_t next = (k + 1) % 3;
    const bool isCrossed = (offsets[k] < 0) != (offsets[next] < 0);
    if (isCrossed || least.mayImprove(std::min(bounds[k], bounds[next])))
      least.offerEdge(face.corners[k], face.corners[next]);
  }
  return least.ball();
}

TouchingBall leastTouchingBall(const Vec3d& point, const Vec3d& faceNormal, const PlaneTriangle& wall, double minDepth,
                               double limit) {
  const Vec3d axis = -faceNormal;
  const DeepPart part(wall, point, axis, minDepth);
  if (part.corners().empty() || part.leastDepth() > withRounding(limit)) return {};
  LeastBall least(wall, axis, part, limit);
  const double offset = least.offsetOf(point);
  if (least.mayImprove(least.boundAt(offset))) least.offerPoint(point, offset);
  return least.ball();
}

}  // namespace asdfvk
