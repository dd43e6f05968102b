#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#include "core/box3.h"
#include "core/simd.h"
#include "trace/vec3_lanes.h"
#include "trace/wall_tree.h"

namespace asdfvk {

/// Margin for rounding in float32 of distances to boxes, at coordinates up to 8.
inline constexpr float kWallBoxMargin = 0x1p-19F;
/// Margins for rounding in float32 of distances to planes, and of cosines, at coordinates up to 2.
inline constexpr float kWallPlaneMargin = 0x1p-19F, kWallCosineMargin = 0x1p-20F;
/// Balls with a larger diameter are assumed to reach every box.
inline constexpr float kMaxBoxedDiameter = 8;
inline constexpr float kUnlimitedDiameter = 0x1p60F;
/// Squared distances below this number are taken as this number, so that their root has an inverse.
inline constexpr float kMinSquaredWay = 0x1p-60F;
/// The least depth in float32 that is exact enough for the computation of a limit.
inline constexpr float kMinLimitDepth = 0x1p-17F;

/// The balls of some queries, one query per lane. A traversal of the hierarchy lowers the upper limits of the diameters
/// by a point of each wall. The traversal also collects the walls whose planes are within the limits. At the end, the
/// collected walls that are still within the limits are measured.
template <typename Floats>
class BallPacket {
 public:
  static constexpr size_t kSize = kLaneCount<Floats>;

  ASDFVK_ALWAYS_INLINE BallPacket(const WallTree& tree, std::span<BallQuery> queries) : tree_(tree), queries_(queries) {
    for (size_t lane = 0; lane < kSize; ++lane) {
      const BallQuery& query = queries[std::min(lane, queries.size() - 1)];
      setLane(normal_, lane, query.triangle.normal);
      Box3d box;
      for (size_t k = 0; k < 3; ++k) {
        setLane(corners_[k], lane, query.triangle.corners[k]);
        box.add(query.triangle.corners[k]);
      }
      setLane(corners_[3], lane, query.point);
      setLane(boxMin_, lane, box.min);
      setLane(boxMax_, lane, box.max);
      double reach = 0;
      for (const Vec3d& corner : query.triangle.corners) reach = std::max(reach, length(corner - query.point));
      reach_[lane] = static_cast<float>(1 + reach);  // Adding 1 covers the rounding of the dot products.
      isUsed_[lane] = lane < queries.size() ? -1 : 0;
      bodies_[lane] = static_cast<int32_t>(query.body);
      leastLimit_[lane] = asFloat(query.least.ball.diameter);
      atPointLimit_[lane] = asFloat(query.atPoint.ball.diameter);
    }
    placeBalls();
    first_ = Vec3f(queries.front().point);
    axis_ = Vec3f(-queries.front().triangle.normal);
  }

  ASDFVK_ALWAYS_INLINE void run() {
    std::array<uint32_t, kMaxBvhDepth + 2> stack;
    size_t stackSize = 0;
    if (!tree_.nodes().empty()) stack[stackSize++] = 0;
    while (stackSize > 0) {
      const WallNode& node = tree_.nodes()[stack[--stackSize]];
      const Mask isNear = reach(node) & mayOppose(node) & isUsed_;
      // Without reachDisc(), a whole run takes 6 % more CPU seconds (horse); without mayOppose(), 60 % more.
      if (!anyLane(isNear) || !anyLane(reachDisc(node, isNear))) continue;
      if (node.wallCount > 0) {
        for (uint32_t i = node.first; i < node.first + node.wallCount; ++i) test(tree_.walls()[i]);
        continue;
      }
      const WallNode &left = tree_.nodes()[node.first], &right = tree_.nodes()[node.first + 1];
      // A fixed order takes 6 % more CPU seconds of a whole run (horse).
      const uint32_t leftFirst = diameterAt(left.middle) < diameterAt(right.middle) ? 1 : 0;
      stack[stackSize++] = node.first + leftFirst;
      stack[stackSize++] = node.first + 1 - leftFirst;
    }
    for (size_t lane = 0; lane < queries_.size(); ++lane) measure(lane);
  }

  /// Lowers the limits to the diameters of the balls through a point of `wall`, which is probably near. Without such
  /// walls, a whole run takes 16 % more CPU seconds (horse).
  ASDFVK_ALWAYS_INLINE void offer(const Wall& wall) {
    const Mask opposing =
        lessEqual(dotLanes(wall.normal, normal_), cosineLimit(-kWallCosineMargin)) & isUsed_ & mayBound(wall);
    if (!anyLane(opposing)) return;
    const Lanes q = pointOf(wall);
    shrinkLimits(q, tangentAt(q, opposing), opposing);
  }

 private:
  using Mask = IntsOf<Floats>;
  using Lanes = Vec3Lanes<Floats>;

  /// The balls that touch the triangles at BallQuery::point, and pass through a point q.
  struct Tangent {
    Floats diameter;  ///< Upper bound that covers rounding; unlimited if unknown.
    Floats lowest;    ///< Lower bound; 0 if unknown.
    Lanes slope;      ///< Gradient of the diameter with respect to q.
    Floats doubt;     ///< Rounding error of the slope.
  };

  /// A wall, and the least diameters of the balls that touch the plane of the wall.
  struct Candidate {
    uint32_t face;
    float least, atPoint;
  };

  ASDFVK_ALWAYS_INLINE static Floats orUnlimited(const Mask& mask, const Floats& diameter) {
    return select(mask, diameter) + select(~mask, broadcast<Floats>(kUnlimitedDiameter));
  }
  static float asFloat(double diameter) { return static_cast<float>(std::min<double>(diameter, kUnlimitedDiameter)); }
  static void setLane(Lanes& lanes, size_t lane, const Vec3d& v) {
    lanes.x[lane] = static_cast<float>(v.x);
    lanes.y[lane] = static_cast<float>(v.y);
    lanes.z[lane] = static_cast<float>(v.z);
  }
  /// Computes the bounds of the balls from the greater limit: at each point of the triangle, a larger ball contains the
  /// smaller balls.
  ASDFVK_ALWAYS_INLINE void placeBalls() {
    const Floats limit = asdfvk::max(leastLimit_, atPointLimit_);
    radius_ = 0.5F * asdfvk::min(limit, broadcast<Floats>(kMaxBoxedDiameter));
    const auto shifted = [&](const Lanes& v) ASDFVK_ALWAYS_INLINE {
      return Lanes{v.x - radius_ * normal_.x, v.y - radius_ * normal_.y, v.z - radius_ * normal_.z};
    };
    low_ = shifted(boxMin_);
    high_ = shifted(boxMax_);
    centre_ = shifted(corners_[3]);
    const Floats reach = radius_ + kWallBoxMargin;
    const Mask isBoxed = lessEqual(limit, broadcast<Floats>(kMaxBoxedDiameter));
    squaredRadius_ = orUnlimited(isBoxed, reach * reach);
  }
  ASDFVK_ALWAYS_INLINE Mask reach(const auto& box) const {
    return lessEqual(squaredDistance(box.min, box.max, low_, high_), squaredRadius_);
  }
  /// Diameter of the ball of the first query through a point; a large number if the point is behind the face.
  [[nodiscard]] float diameterAt(const Vec3f& q) const {
    const Vec3f v = q - first_;
    return asdfvk::dot(v, v) / std::max(asdfvk::dot(v, axis_), kMinLimitDepth);
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Floats cosineLimit(float margin) const {
    return broadcast<Floats>(static_cast<float>(tree_.opposing().cosine) + margin);
  }

  /// Lanes whose faces may bound the same body as the wall (Solids::mayBoundOneBody()).
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Mask mayBound(const Wall& wall) const {
    if (wall.body == kNoBody) return ~Mask{};
    const auto differs = [&](uint32_t body) ASDFVK_ALWAYS_INLINE {
      return notEqual(bodies_, broadcast<Mask>(static_cast<int32_t>(body)));
    };
    return ~(differs(wall.body) & differs(kNoBody));
  }

  /// Lanes whose faces may have an opposing wall below the node.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Mask mayOppose(const WallNode& node) const {
    const auto least = [&](float min, float max, const Floats& component)
                           ASDFVK_ALWAYS_INLINE { return asdfvk::min(component * min, component * max); };
    const Floats cosine = least(node.normalMin.x, node.normalMax.x, normal_.x) +
                          least(node.normalMin.y, node.normalMax.y, normal_.y) +
                          least(node.normalMin.z, node.normalMax.z, normal_.z);
    return lessEqual(cosine, cosineLimit(kWallCosineMargin));
  }

  /// Lanes whose balls may reach the cylinder of the node (WallNode::axis).
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Mask reachDisc(const WallNode& node, const Mask& lanes) const {
    const Tangent tangent = tangentAt(inAllLanes<Floats>(node.middle), lanes);
    const Floats along = dotLanes(node.axis, tangent.slope), square = dotLanes(tangent.slope, tangent.slope);
    const Floats across = asdfvk::max(square - along * along, Floats{}) + kWallBoxMargin * (1 + square);
    // The lower bound without the term sqrt(across) * radius; the lambda below squares this term.
    const Floats atPoint =
        tangent.lowest + asdfvk::min(along * node.lowest, along * node.highest) - tangent.doubt * node.reach;
    const Floats change = across * (node.radius * node.radius * (1 + kWallBoxMargin));
    const auto reaches = [&](const Floats& bound, const Floats& limit) ASDFVK_ALWAYS_INLINE {
      const Floats above = asdfvk::max(bound - limit, Floats{});
      return lessEqual(above * above, change);
    };
    return lanes & (reaches(leastBound(tangent, atPoint), leastLimit_) | reaches(atPoint, atPointLimit_));
  }

  /// Lower bound of the diameters at all points of the triangle. The diameter is a convex function of both points.
  /// Therefore it is at least its tangent at BallQuery::point and a point of the wall. atPoint: lower bound at
  /// BallQuery::point.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Floats leastBound(const Tangent& tangent, const Floats& atPoint) const {
    return atPoint - greatestCorner(tangent.slope) - tangent.doubt * reach_;
  }

  /// Whether the tangent at the middle of a wall is a poor bound at its corners. Without the nearest points, a whole
  /// run takes 30 % more CPU seconds (tube of 32,000 long faces).
  [[nodiscard]] ASDFVK_ALWAYS_INLINE bool isLong(const Wall& wall) const {
    return anyLane(lessEqual(radius_, broadcast<Floats>(wall.reach)));
  }

  /// Points of a wall, for bounds. The nearer to the balls, the better: on a long wall nearly the nearest to centre_.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Lanes pointOf(const Wall& wall) const {
    return isLong(wall) ? nearlyNearestPoint(wall.normal, wall.middle, wall.spokes, centre_)
                        : inAllLanes<Floats>(wall.middle);
  }

  /// The least position of the corners of a wall along a direction, relative to the middle of the wall.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE static Floats leastCorner(const Wall& wall, const Lanes& direction) {
    return asdfvk::min(asdfvk::min(dotLanes(wall.spokes[0], direction), dotLanes(wall.spokes[1], direction)),
                       dotLanes(wall.spokes[2], direction));
  }
  /// The greatest position of the corners of the triangle along a direction, relative to BallQuery::point.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Floats greatestCorner(const Lanes& direction) const {
    return asdfvk::max(asdfvk::max(dotLanes(corners_[0], direction), dotLanes(corners_[1], direction)),
                       dotLanes(corners_[2], direction)) -
           dotLanes(corners_[3], direction);
  }

  /// Lanes whose balls do not reach a wall: at BallQuery::point, and at all points of the triangle.
  struct Separated {
    Mask atPoint, atFace;
  };
  /// nearest: points of the wall. Each plane perpendicular to the line from centre_ to such a point may separate the
  /// balls from the wall; the nearer the point is to centre_, the more often. The ball of radius_ contains the smaller
  /// balls of limits that were lowered since placeBalls().
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Separated separatedBy(const Lanes& nearest, const Wall& wall) const {
    const Lanes way{nearest.x - centre_.x, nearest.y - centre_.y, nearest.z - centre_.z};
    const Floats square = dotLanes(way, way), inverse = rsqrt(asdfvk::max(square, broadcast<Floats>(kMinSquaredWay)));
    const Floats distance = square * inverse, rounding = kWallBoxMargin * (1 + distance + reach_);
    const Lanes axis{way.x * inverse, way.y * inverse, way.z * inverse};
    const Lanes toMiddle{wall.middle.x - centre_.x, wall.middle.y - centre_.y, wall.middle.z - centre_.z};
    const Floats wallBegin = dotLanes(toMiddle, axis) + leastCorner(wall, axis);
    const Floats radius = 0.5F * leastLimit_;
    const Floats ballsEnd = greatestCorner(axis) + (radius_ - radius) * dotLanes(normal_, axis) + radius;
    const Mask isBoxed = lessEqual(asdfvk::max(leastLimit_, atPointLimit_), broadcast<Floats>(kMaxBoxedDiameter));
    return {isBoxed & lessEqual(radius_ + rounding, wallBegin), isBoxed & lessEqual(ballsEnd + rounding, wallBegin)};
  }

  ASDFVK_ALWAYS_INLINE void test(const Wall& wall) {
    const Floats cosine = dotLanes(wall.normal, normal_);
    const Mask opposing = lessEqual(cosine, cosineLimit(kWallCosineMargin)) & isUsed_ & mayBound(wall);
    if (!anyLane(opposing)) return;
    // A ball that touches the wall is at least as large as the ball that touches the plane of the wall. Without this
    // bound, a whole run takes 5 % more CPU seconds (horse).
    std::array<Floats, 4> offsets;
    for (size_t k = 0; k < 4; ++k) offsets[k] = wall.offset - dotLanes(wall.normal, corners_[k]);
    const Floats smallest = broadcast<Floats>(kWallCosineMargin);
    const Floats below = 2 / asdfvk::max(1 - cosine, smallest), above = 2 / asdfvk::max(1 + cosine, smallest);
    const auto boundOf = [&](const Floats& lowest, const Floats& highest) ASDFVK_ALWAYS_INLINE {
      return asdfvk::max((lowest - kWallPlaneMargin) * below, (-highest - kWallPlaneMargin) * above);
    };
    const Floats atPoint = boundOf(offsets[3], offsets[3]);
    const Floats least = boundOf(asdfvk::min(asdfvk::min(offsets[0], offsets[1]), offsets[2]),
                                 asdfvk::max(asdfvk::max(offsets[0], offsets[1]), offsets[2]));
    Mask isNear = opposing & (lessEqual(least, leastLimit_) | lessEqual(atPoint, atPointLimit_));
    if (!anyLane(isNear)) return;
    isNear &= reach(wall);
    if (!anyLane(isNear)) return;
    const Lanes q = pointOf(wall);
    const Tangent tangent = tangentAt(q, isNear);
    const Lanes toMiddle{wall.middle.x - q.x, wall.middle.y - q.y, wall.middle.z - q.z};
    const Floats pointBound = tangent.lowest + dotLanes(toMiddle, tangent.slope) + leastCorner(wall, tangent.slope) -
                              tangent.doubt * (3 * wall.reach);
    Floats leastAtFace = asdfvk::max(least, leastBound(tangent, pointBound));
    Floats leastAtPoint = asdfvk::max(atPoint, pointBound);
    // Without separatedBy(), a whole run takes 4 % more CPU seconds (tube of 32,000 long faces).
    if (isLong(wall)) {
      const Separated separated = separatedBy(q, wall);
      leastAtFace = orUnlimited(~separated.atFace, leastAtFace);
      leastAtPoint = orUnlimited(~separated.atPoint, leastAtPoint);
    }
    const auto isWithinLimits = [&]() ASDFVK_ALWAYS_INLINE {
      return lessEqual(leastAtFace, leastLimit_) | lessEqual(leastAtPoint, atPointLimit_);
    };
    isNear &= isWithinLimits();
    if (!anyLane(isNear)) return;
    const Mask isSure = isNear & lessEqual(cosine, cosineLimit(-kWallCosineMargin));
    // Limits that are lowered only by the measured balls take 15 % more CPU seconds of a whole run (horse).
    if (anyLane(isSure) && shrinkLimits(q, tangent, isSure)) isNear &= isWithinLimits();
    for (uint32_t lanes = bitsOf(isNear); lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(lanes));
      collect(lane, {wall.face, leastAtFace[lane], leastAtPoint[lane]});
    }
  }

  [[nodiscard]] ASDFVK_ALWAYS_INLINE Tangent tangentAt(const Lanes& q, const Mask& lanes) const {
    const Lanes v{q.x - corners_[3].x, q.y - corners_[3].y, q.z - corners_[3].z};
    const Floats depth = -dotLanes(v, normal_), inverse = 1 / asdfvk::max(depth, broadcast<Floats>(kMinLimitDepth));
    const Mask isDeep = lanes & lessEqual(broadcast<Floats>(kMinLimitDepth), depth);
    const Floats diameter = dotLanes(v, v) * inverse, rounding = diameter * kWallBoxMargin * (1 + inverse);
    const auto slope = [&](const Floats& along, const Floats& normal)
                           ASDFVK_ALWAYS_INLINE { return select(isDeep, (2 * along + diameter * normal) * inverse); };
    return {orUnlimited(isDeep, diameter + rounding),
            select(isDeep, diameter - rounding),
            {slope(v.x, normal_.x), slope(v.y, normal_.y), slope(v.z, normal_.z)},
            select(isDeep, (kWallPlaneMargin + 2 * rounding) * inverse)};
  }

  /// Lowers the limits to the diameters of the balls through a point of a wall. Returns whether a limit changed.
  ASDFVK_ALWAYS_INLINE bool shrinkLimits(const Lanes& q, const Tangent& tangent, const Mask& lanes) {
    const Floats diameter = orUnlimited(lanes, tangent.diameter);
    const Floats atPoint = asdfvk::min(atPointLimit_, diameter);
    Floats least = asdfvk::min(leastLimit_, diameter);
    // Limits without the corners take 9 % more CPU seconds of a whole run (horse).
    for (size_t k = 0; k < 3; ++k) {
      const Lanes v{q.x - corners_[k].x, q.y - corners_[k].y, q.z - corners_[k].z};
      const Floats depth = -dotLanes(v, normal_);
      const Mask isDeep = lanes & lessEqual(broadcast<Floats>(kMinLimitDepth), depth);
      const Floats atCorner = dotLanes(v, v) / depth * (1 + kWallBoxMargin + kWallBoxMargin / depth);
      least = asdfvk::min(least, orUnlimited(isDeep, atCorner));
    }
    if (!anyLane(notEqual(least, leastLimit_) | notEqual(atPoint, atPointLimit_))) return false;
    leastLimit_ = least;
    atPointLimit_ = atPoint;
    placeBalls();
    return true;
  }

  /// Measuring each wall at once takes 20 % more CPU seconds of a whole run (horse).
  void collect(size_t lane, const Candidate& candidate) {
    size_t& count = counts_[lane];
    if (count == kMaxCandidateCount) {
      const auto isNear = [&](const Candidate& other) {
        return other.least <= leastLimit_[lane] || other.atPoint <= atPointLimit_[lane];
      };
      const auto end = std::partition(candidates_[lane].begin(), candidates_[lane].end(), isNear);
      count = static_cast<size_t>(end - candidates_[lane].begin());
      if (count > kMaxCandidateCount / 2) {
        measure(lane);
        leastLimit_[lane] = std::min<float>(leastLimit_[lane], withMargin(queries_[lane].least.ball.diameter));
        atPointLimit_[lane] = std::min<float>(atPointLimit_[lane], withMargin(queries_[lane].atPoint.ball.diameter));
      }
    }
    candidates_[lane][count++] = candidate;
  }
  static float withMargin(double diameter) { return asFloat(diameter * (1 + kWallBoxMargin)); }

  /// Shrinks the balls of a query by its candidates, in ascending order of their bounds. The order in which they were
  /// found takes 2 % more CPU seconds of a whole run (horse).
  void measure(size_t lane) {
    const std::span<Candidate> found(candidates_[lane].data(), std::exchange(counts_[lane], 0));
    BallQuery& query = queries_[lane];
    const auto measureBy = [&](float Candidate::*bound, double limit, InscribedBall& best, const auto& ballAt) {
      for (std::span<Candidate> rest = found; !rest.empty(); rest = rest.subspan(1)) {
        const auto nearest = std::min_element(
            rest.begin(), rest.end(), [&](const Candidate& a, const Candidate& b) { return a.*bound < b.*bound; });
        if ((*nearest).*bound > std::min(limit, best.ball.diameter)) break;
        std::swap(rest.front(), *nearest);
        const uint32_t face = rest.front().face;
        if (!tree_.opposing().contain(query.triangle.normal, tree_.scene().geometry.normals[face])) continue;
        const TouchingBall ball = ballAt(triangleOf(tree_.scene(), face), std::min(limit, best.ball.diameter));
        if (std::isinf(ball.diameter) || ball.diameter > best.ball.diameter) continue;
        if (ball.diameter < best.ball.diameter || face < best.wall) best = {ball, face};
      }
    };
    measureBy(&Candidate::atPoint, atPointLimit_[lane], query.atPoint, [&](const PlaneTriangle& wall, double limit) {
      return leastTouchingBall(query.point, query.triangle.normal, wall, kContactDistance, limit);
    });
    const double leastLimit = std::min<double>(leastLimit_[lane], query.atPoint.ball.diameter);
    measureBy(&Candidate::least, leastLimit, query.least, [&](const PlaneTriangle& wall, double limit) {
      return leastTouchingBall(query.triangle, wall, kContactDistance, limit);
    });
  }

  static constexpr size_t kMaxCandidateCount = 64;

  const WallTree& tree_;
  std::span<BallQuery> queries_;
  Vec3f first_, axis_;  ///< Point and axis of the first query. The first query decides the order of the nodes.
  Lanes normal_, boxMin_, boxMax_;
  std::array<Lanes, 4> corners_;      ///< Corners of the triangle, and the point.
  Floats leastLimit_, atPointLimit_;  ///< Limits of the diameters.
  Lanes low_, high_;                  ///< Box of the centres of the balls of the greater limit.
  Lanes centre_;                      ///< Centre of this ball at BallQuery::point.
  Floats radius_, squaredRadius_;
  Floats reach_;  ///< 1 + the length from the point to the corners.
  Mask isUsed_, bodies_;
  std::array<std::array<Candidate, kMaxCandidateCount>, kSize> candidates_;
  std::array<size_t, kSize> counts_{};
};

}  // namespace asdfvk
