#include "trace/surface_disc.h"

#include <algorithm>
#include <array>
#include <utility>

#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// Share of the limit: the greatest length of pieces whose thickness is taken as linear.
constexpr double kLinearLength = 0.26;
constexpr double kSlack = 1 + 1e-9;
/// Clipping a piece takes as long as visiting this number of faces.
constexpr size_t kClippedWork = 16;
/// Number of pieces whose corners are measured together: 15 of 16 lanes.
constexpr size_t kMeasuredTogether = 5;

/// A triangle and a linear function on it.
struct LinearTriangle {
  PlaneTriangle triangle;
  std::array<double, 3> values;
};

enum class LevelSide { Below, Above };

/// Among the points of a triangle at which the function is at most the level (LevelSide::Below), or at least the level
/// (LevelSide::Above): the point nearest to p.
std::optional<Vec3d> nearestOnSide(const LinearTriangle& linear, LevelSide side, double level, const Vec3d& p) {
  std::array<Vec3d, 4> part;
  size_t count = 0;
  const auto isPart = [&](size_t k) {
    return side == LevelSide::Below ? linear.values[k] <= level : linear.values[k] >= level;
  };
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    const Vec3d& corner = linear.triangle.corners[k];
    if (isPart(k)) part[count++] = corner;
    if (isPart(k) != isPart(next))
      part[count++] = corner + (level - linear.values[k]) / (linear.values[next] - linear.values[k]) *
                                   (linear.triangle.corners[next] - corner);
  }
  if (count < 3) return {};
  Vec3d nearest = nearestPoint({{part[0], part[1], part[2]}, linear.triangle.normal}, p);
  if (count == 4) {
    const Vec3d other = nearestPoint({{part[0], part[2], part[3]}, linear.triangle.normal}, p);
    if (length(other - p) < length(nearest - p)) nearest = other;
  }
  return nearest;
}

std::optional<Contradiction> contradictionIn(const LinearTriangle& linear, uint32_t face,
                                             const SurfacePointDisc& disc) {
  const double thin = kThinShare * disc.limit, thinner = kTaperShare * disc.diameter();
  if (const auto point = nearestOnSide(linear, LevelSide::Below, thinner / kSlack, disc.point);
      point && length(*point - disc.point) <= kTaperReach * disc.limit)
    return Contradiction{*point, face, thinner / kSlack, true};
  if (const auto point = nearestOnSide(linear, LevelSide::Above, thin, disc.point);
      point && length(*point - disc.point) <= kThinReach * disc.limit)
    return Contradiction{*point, face, thin, false};
  return {};
}

/// A convex polygon with at most 7 corners.
struct Polygon {
  std::array<Vec3d, 8> corners;
  size_t count = 0;

  /// Cuts off the points with dot(axis, point) > end.
  [[nodiscard]] Polygon cut(const Vec3d& axis, double end) const {
    Polygon result;
    for (size_t k = 0; k < count; ++k) {
      const Vec3d &a = corners[k], &b = corners[(k + 1) % count];
      const double from = dot(axis, a) - end, to = dot(axis, b) - end;
      if (from <= 0) result.corners[result.count++] = a;
      if ((from <= 0) != (to <= 0)) result.corners[result.count++] = a + from / (from - to) * (b - a);
    }
    return result;
  }
};

}  // namespace

DiscCheck::DiscCheck(ThinPieces& pieces) : pieces_(pieces), visits_(pieces.tree().scene().mesh.faceCount()) {}

std::optional<Contradiction> DiscCheck::contradictionAt(const SurfacePointDisc& disc) {
  if (disc.diameter() >= kThinShare * disc.limit) return Contradiction{disc.point, disc.face, disc.diameter(), false};
  std::optional<Contradiction> found = taperAt(disc);
  if (found) return found;
  uncertain_.clear();
  forEachFaceAround(disc, [&](uint32_t face, const Vec3d& nearest, double distance) {
    if (const uint32_t root = pieces_.rootOf(face); root != kNoPiece)
      found = contradictionIn(root, disc);
    else if (distance <= kThinReach * disc.limit)
      found = {nearest, face, pieces_.limit(), false};
    if (!found) found = rimNear(face, disc);
    return !found;
  });
  for (size_t i = 0; i < uncertain_.size() && !found; ++i) {
    if (i % kMeasuredTogether == 0)
      pieces_.measureCorners(std::span(uncertain_).subspan(i, std::min(kMeasuredTogether, uncertain_.size() - i)));
    found = hiddenContradictionIn(uncertain_[i], disc);
  }
  return found;
}

/// The opposing wall at the middle is a bound for all points of the face. This bound is least towards the point that
/// the ball touches.
std::optional<Contradiction> DiscCheck::taperAt(const SurfacePointDisc& disc) const {
  if (disc.ball.wall == kNoFace) return {};
  const TraceScene& scene = pieces_.tree().scene();
  const Vec3d &normal = pieces_.normal(disc.face), way = disc.ball.ball.onWall - disc.point;
  const Vec3d aside = way - dot(way, normal) * normal;
  const double distance = length(aside), reach = kTaperReach * disc.limit;
  if (distance == 0) return {};
  const Vec3d point = nearestPoint(triangleOf(scene, disc.face), disc.point + reach / distance * aside);
  const double diameter =
      leastTouchingBall(point, normal, triangleOf(scene, disc.ball.wall), kContactDistance, disc.diameter()).diameter;
  if (diameter >= kTaperShare * disc.diameter() || length(point - disc.point) > reach * kSlack) return {};
  return Contradiction{point, disc.face, diameter, true};
}

/// Looks at the pieces of a face. Pieces that need a closer look are added to uncertain_.
std::optional<Contradiction> DiscCheck::contradictionIn(uint32_t index, const SurfacePointDisc& disc) {
  const double thin = kThinShare * disc.limit, thinReach = kThinReach * disc.limit;
  const ThinPiece& piece = pieces_[index];
  const Vec3d nearest = nearestPoint({piece.corners, pieces_.normal(piece.face)}, disc.point);
  const double distance = length(nearest - disc.point), least = piece.least.ball.diameter;
  if (distance > kTaperReach * disc.limit) return {};
  if (least >= thin) {
    if (distance > thinReach) return {};
    return Contradiction{nearest, piece.face, least, false};
  }
  const bool mayBeThick = piece.greatest >= thin && distance <= thinReach;
  const bool mayBeThinner = least < kTaperShare * disc.diameter();
  const Vec3d& thinnest = piece.least.ball.onFace;
  if (mayBeThinner && length(thinnest - disc.point) <= kTaperReach * disc.limit)
    return Contradiction{thinnest, piece.face, least, true};
  if (!mayBeThick && !mayBeThinner) return {};
  if (const Vec3d middle = middleOf(piece.corners);
      mayBeThick && piece.atMiddle >= thin && length(middle - disc.point) <= thinReach)
    return Contradiction{middle, piece.face, piece.atMiddle, false};
  if (piece.firstHalf == kNoPiece) {
    uncertain_.push_back(index);
    return {};
  }
  if (std::optional<Contradiction> found = contradictionIn(piece.firstHalf, disc)) return found;
  return contradictionIn(piece.firstHalf + 1, disc);
}

std::optional<Contradiction> DiscCheck::hiddenContradictionIn(uint32_t index, const SurfacePointDisc& disc) {
  if (longestSideOf(pieces_[index].corners).second > kLinearLength * disc.limit)
    return contradictionInClipped(index, disc);
  const ThinPiece& piece = pieces_[index];
  return asdfvk::contradictionIn({{piece.corners, pieces_.normal(piece.face)}, piece.atCorners}, piece.face, disc);
}

/// Clips a piece to a square around the disc, and measures the fan of triangles of the clipped polygon.
std::optional<Contradiction> DiscCheck::contradictionInClipped(uint32_t index, const SurfacePointDisc& disc) const {
  const ThinPiece& piece = pieces_[index];
  const Vec3d& normal = pieces_.normal(piece.face);
  const size_t longest = longestSideOf(piece.corners).first;
  const Vec3d side = piece.corners[(longest + 1) % 3] - piece.corners[longest];
  const Vec3d along = side / length(side), across = cross(normal, along);
  Polygon polygon{{piece.corners[0], piece.corners[1], piece.corners[2]}, 3};
  const double reach = kTaperReach * disc.limit;
  for (const Vec3d& axis : {along, across})
    for (const double sign : {1.0, -1.0}) polygon = polygon.cut(sign * axis, sign * dot(axis, disc.point) + reach);
  if (polygon.count < 3) return {};
  work_ += kClippedWork;
  std::array<BallQuery, 8> queries;
  for (size_t k = 0; k < polygon.count; ++k) {
    const Vec3d& corner = polygon.corners[k];
    std::array<Vec3d, 3> triangle{corner, corner, corner};
    if (k >= 2) triangle = {polygon.corners[0], polygon.corners[k - 1], corner};
    queries[k] = pieces_.queryAt(piece.face, triangle, corner, kCornerRange * pieces_.limit(),
                                 {piece.least.wall, piece.middleWall});
  }
  pieces_.tree().shrink({queries.data(), polygon.count});
  for (size_t k = 2; k < polygon.count; ++k) {
    const TouchingBall& least = queries[k].least.ball;
    const auto& [a, b, c] = queries[k].triangle.corners;
    const bool isPoint = a == b && a == c;  // Then `least` was not searched, see ThinPieces::queryAt().
    if (!isPoint && least.diameter < kTaperShare * disc.diameter() && length(least.onFace - disc.point) <= reach)
      return Contradiction{least.onFace, piece.face, least.diameter, true};
    const auto valueAt = [&](size_t corner) { return queries[corner].atPoint.ball.diameter; };
    const LinearTriangle linear{queries[k].triangle, {valueAt(0), valueAt(k - 1), valueAt(k)}};
    if (std::optional<Contradiction> found = asdfvk::contradictionIn(linear, piece.face, disc)) return found;
  }
  return {};
}

/// Looks for a rim: an edge at which the surface turns to the other side of the wall.
std::optional<Contradiction> DiscCheck::rimNear(uint32_t face, const SurfacePointDisc& disc) const {
  const TraceScene& scene = pieces_.tree().scene();
  const Vec3d& normal = pieces_.normal(disc.face);
  for (size_t k = 0; k < 3; ++k) {
    const std::optional<Vec3d> nearest = nearestOnEdge(face, k, disc);
    if (!nearest) continue;
    bool goesOn = false, turns = false;
    forEachFaceAtEdge(face, k, [&](uint32_t other) {
      const bool isSameSide =
          scene.geometry.isDegenerate(other) || dot(normal, pieces_.normal(other)) > kSameSideCosine;
      (isSameSide ? goesOn : turns) = true;
    });
    if (turns && !goesOn) return Contradiction{*nearest, face, 0, true};
  }
  return {};
}

/// The point of an edge that is nearest to the middle of the disc; unset if it is out of reach, or the edge has no
/// length.
std::optional<Vec3d> DiscCheck::nearestOnEdge(uint32_t face, size_t k, const SurfacePointDisc& disc) const {
  const std::array<Vec3d, 3> corners = triangleOf(pieces_.tree().scene(), face).corners;
  const Vec3d &from = corners[k], &to = corners[(k + 1) % 3];
  if (from == to) return {};
  const Vec3d nearest = nearestOnSegment(from, to, disc.point);
  if (length(nearest - disc.point) > kTaperReach * disc.limit) return {};
  return nearest;
}

/// Visits the other faces that have the edge from corner k to the next corner.
void DiscCheck::forEachFaceAtEdge(uint32_t face, size_t k, FunctionRef<void(uint32_t)> visit) const {
  const TriangleMesh& mesh = pieces_.tree().scene().mesh;
  const PointFans& fans = pieces_.fans();
  const uint32_t end = fans.pointOf(mesh.faces[face][(k + 1) % 3]);
  for (const uint32_t corner : fans.cornersAt(fans.pointOf(mesh.faces[face][k]))) {
    const Face& vertices = mesh.faces[corner / 3];
    const auto isEnd = [&](uint32_t vertex) { return fans.pointOf(vertex) == end; };
    if (corner / 3 != face && std::any_of(vertices.begin(), vertices.end(), isEnd)) visit(corner / 3);
  }
}

/// Walks over the surface from the face of the disc. The walk does not leave the ball of radius kTaperReach * limit,
/// and does not go to the other side of the wall. It visits near faces first. visit(face, nearest point, distance)
/// returns whether the walk goes on.
void DiscCheck::forEachFaceAround(const SurfacePointDisc& disc,
                                  FunctionRef<bool(uint32_t, const Vec3d&, double)> visit) {
  const TraceScene& scene = pieces_.tree().scene();
  const PointFans& fans = pieces_.fans();
  const Vec3d& normal = pieces_.normal(disc.face);
  const double reach = kTaperReach * disc.limit;
  ++walkCount_;
  queue_.assign(1, disc.face);
  visits_[disc.face] = walkCount_;
  const auto add = [&](uint32_t face) {
    if (std::exchange(visits_[face], walkCount_) != walkCount_) queue_.push_back(face);
  };
  for (size_t i = 0; i < queue_.size(); ++i) {
    ++work_;
    const uint32_t face = queue_[i];
    if (!scene.geometry.isDegenerate(face)) {
      if (!(dot(normal, pieces_.normal(face)) > kSameSideCosine)) continue;
      const Vec3d nearest = nearestPoint(triangleOf(scene, face), disc.point);
      const double distance = length(nearest - disc.point);
      if (distance > reach) continue;
      if (!visit(face, nearest, distance)) return;
    }
    // The part of a triangle in the ball is convex. So it is enough to cross edges and vertices in the ball.
    const std::array<Vec3d, 3> corners = triangleOf(scene, face).corners;
    const auto addFan = [&](size_t k) {
      for (const uint32_t corner : fans.cornersAt(fans.pointOf(scene.mesh.faces[face][k]))) add(corner / 3);
    };
    for (size_t k = 0; k < 3; ++k) {
      if (length(corners[k] - disc.point) <= reach) {
        addFan(k);
      } else if (nearestOnEdge(face, k, disc)) {
        bool isShared = false;
        forEachFaceAtEdge(face, k, [&](uint32_t other) {
          isShared = true;
          add(other);
        });
        if (isShared) continue;
        addFan(k);  // At a T-junction, the faces behind the edge have its ends in common with others.
        addFan((k + 1) % 3);
      }
    }
  }
}

}  // namespace asdfvk
