#include "trace/wall_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// Number of points per piece. If a point is not a wall, the next point is farther from the contradiction.
constexpr int kPointsPerPiece = 4;
/// Number of limits per point at which a detail is looked for.
constexpr int kLimitsPerPoint = 16;
/// Walls are as thick as each other within this relative difference.
constexpr double kEqualWalls = 1e-3;
constexpr double kSlack = 1 + 1e-9;
/// A point is moved beyond the reach of a contradiction by this share.
constexpr double kStepBeyond = 1.0 / 64;
/// Shares of the limit: the greatest length of pieces whose middle stands for their points and whose thickness is taken
/// as linear, and the size of cells of which one point is tested.
constexpr double kPointSpacing = 1.0 / 4, kCellSize = 1.0 / 8;

double farthestCorner(const ThinPiece& piece, const Vec3d& point) {
  double farthest = 0;
  for (const Vec3d& corner : piece.corners) farthest = std::max(farthest, length(corner - point));
  return farthest;
}

/// The point of a triangle nearest to p at which a linear function is at most `level`. values: the function at the
/// corners.
std::optional<Vec3d> nearestBelow(const PlaneTriangle& triangle, const std::array<double, 3>& values, double level,
                                  const Vec3d& p) {
  std::array<Vec3d, 4> part;
  size_t count = 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    const Vec3d& corner = triangle.corners[k];
    const bool isBelow = values[k] <= level;
    if (isBelow) part[count++] = corner;
    if (isBelow != (values[next] <= level))
      part[count++] = corner + (level - values[k]) / (values[next] - values[k]) * (triangle.corners[next] - corner);
  }
  if (count < 3) return {};
  Vec3d nearest = nearestPoint({{part[0], part[1], part[2]}, triangle.normal}, p);
  if (count == 4) {
    const Vec3d other = nearestPoint({{part[0], part[2], part[3]}, triangle.normal}, p);
    if (length(other - p) < length(nearest - p)) nearest = other;
  }
  return nearest;
}

/// Points of one cell that look in one direction stand for each other.
uint64_t cellOf(const Vec3d& point, const Vec3d& normal, double size) {
  uint64_t key = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    key = key << 20 ^ (static_cast<uint64_t>(std::floor((point[axis] + 2) / size)) & 0xfffff);
  size_t axis = 0;
  for (const size_t other : {size_t{1}, size_t{2}})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  return key << 3 | axis << 1 | (normal[axis] < 0 ? 1 : 0);
}

}  // namespace

WallSearch::WallSearch(ThinPieces& pieces, double limit)
    : pieces_(pieces),
      limit_(limit),
      isExcluded_(pieces.size()),
      visits_(pieces.tree().scene().mesh.faceCount()) {}

std::optional<WallPlace> WallSearch::leastWall(std::span<const uint32_t> pieces) {
  std::optional<WallPlace> best;
  forEachPoint(pieces, limit_, [&](uint32_t index) {
    const double bound = pieces_[index].least.ball.diameter;
    return best && bound >= best->ball.ball.diameter / (1 + kEqualWalls);
  }, [&](const Disc& disc) {
    if (!best || disc.diameter < best->ball.ball.diameter)
      best = {disc.face, disc.point, pieces_.ballAt(disc.face, disc.point), disc.limit};
  });
  return best;
}

std::optional<WallPlace> WallSearch::leastLimit(std::span<const uint32_t> pieces, double floor) {
  std::optional<WallPlace> best;
  forEachPoint(pieces, floor, [&](uint32_t index) {
    const double bound = std::max(floor, pieces_[index].least.ball.diameter / kThinShare);
    return best && bound >= best->limit / (1 + kEqualWalls);
  }, [&](const Disc& disc) {
    if (!best || disc.limit < best->limit)
      best = {disc.face, disc.point, pieces_.ballAt(disc.face, disc.point), disc.limit};
  });
  return best;
}

std::optional<WallPlace> WallSearch::findDetail(std::span<const uint32_t> pieces) {
  std::optional<WallPlace> detail;
  forEachPoint(pieces, kLeastDetailShare * limit_, [&](uint32_t) { return detail.has_value(); }, [&](const Disc& disc) {
    detail = {disc.face, disc.point, pieces_.ballAt(disc.face, disc.point), disc.limit};
  });
  return detail;
}

/// Visits points that are walls at a limit from `floor` to limit_, at the least such limit, by ascending thickness of
/// the pieces. isDone(piece) ends the search.
void WallSearch::forEachPoint(std::span<const uint32_t> pieces, double floor, FunctionRef<bool(uint32_t)> isDone,
                              FunctionRef<void(const Disc&)> visit) {
  std::fill(isExcluded_.begin(), isExcluded_.end(), 0);
  cells_.clear();
  using Entry = std::tuple<double, double, uint32_t>;  // Least diameter, size below 0, piece.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto add = [&](uint32_t piece) {
    if (pieces_.isThin(piece) && isExcluded_[piece] == 0)
      queue.emplace(pieces_[piece].least.ball.diameter, -pieces_[piece].longestSide().second, piece);
  };
  for (const uint32_t piece : pieces) add(piece);
  while (!queue.empty()) {
    const auto [least, size, index] = queue.top();
    queue.pop();
    if (isExcluded_[index] != 0) continue;
    if (isDone(index)) break;
    Disc disc{pieces_[index].face, pieces_[index].middle(), pieces_[index].atMiddle, 0};
    const bool isNew = cells_.insert(cellOf(disc.point, pieces_.normal(disc.face), kCellSize * limit_)).second;
    for (int i = 0; i < kPointsPerPiece && (isNew || -size > kPointSpacing * limit_); ++i) {
      const std::optional<Contradiction> contradiction = contradictionFrom(disc, floor);
      if (!contradiction) {
        visit(disc);
        break;
      }
      if (isExcludedBy(*contradiction, pieces_[index], floor)) {
        exclude(*contradiction, floor);
        break;
      }
      disc.point = pointAwayFrom(*contradiction, disc.point, index, disc.limit);
      disc.diameter = pieces_.ballAt(disc.face, disc.point).ball.diameter;
    }
    if (isExcluded_[index] != 0 || -size <= kPointSpacing * limit_) continue;
    const uint32_t first = halvesOf(index);
    if (first == kNoPiece) continue;
    add(first);
    add(first + 1);
  }
}

/// Sets disc.limit to the least limit from `floor` to limit_ at which the point is a wall. If there is none, returns a
/// contradiction. The disc of a greater limit contains the disc of a smaller one: a thicker point contradicts until the
/// limit is above its thickness, a thinner point always.
std::optional<WallSearch::Contradiction> WallSearch::contradictionFrom(Disc& disc, double floor) {
  disc.limit = std::min(std::max(disc.diameter / kThinShare * kSlack, floor), limit_);
  std::optional<Contradiction> contradiction;
  for (int i = 0; i < kLimitsPerPoint && disc.limit <= limit_; ++i) {
    contradiction = contradictionAt(disc);
    if (!contradiction || contradiction->isThinner || contradiction->diameter >= pieces_.limit()) break;
    disc.limit = contradiction->diameter / kThinShare * (1 + kEqualWalls);
  }
  return contradiction;
}

std::optional<WallSearch::Contradiction> WallSearch::contradictionAt(const Disc& disc) {
  const auto& [face, point, diameter, limit] = disc;
  if (diameter >= kThinShare * limit) return Contradiction{point, face, diameter, false};
  std::optional<Contradiction> found;
  uncertain_.clear();
  const double thinReach = kThinReach * limit;
  forEachFaceAround(point, face, kTaperReach * limit, [&](uint32_t other, const Vec3d& nearest, double distance) {
    if (const uint32_t root = pieces_.rootOf(other); root != kNoPiece)
      found = contradictionIn(root, disc);
    else if (distance <= thinReach)
      found = {nearest, other, pieces_.limit(), false};
    if (!found) found = rimNear(other, disc);
    return !found;
  });
  for (size_t i = 0; i < uncertain_.size() && !found; ++i) found = hiddenContradictionIn(uncertain_[i], disc);
  return found;
}

/// Looks at the pieces of a face. Pieces that need a closer look are added to uncertain_.
std::optional<WallSearch::Contradiction> WallSearch::contradictionIn(uint32_t index, const Disc& disc) {
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
  const bool mayBeThinner = least < kTaperShare * disc.diameter;
  const Vec3d& thinnest = piece.least.ball.onFace;
  if (mayBeThinner && length(thinnest - disc.point) <= kTaperReach * disc.limit)
    return Contradiction{thinnest, piece.face, least, true};
  if (!mayBeThick && !mayBeThinner) return {};
  if (const Vec3d middle = piece.middle();
      mayBeThick && piece.atMiddle >= thin && length(middle - disc.point) <= thinReach)
    return Contradiction{middle, piece.face, piece.atMiddle, false};
  const uint32_t first =
      piece.longestSide().second > kPointSpacing * std::max(disc.limit, 0.5 * limit_) ? halvesOf(index) : pieces_[index].firstHalf;
  if (first == kNoPiece) {
    uncertain_.push_back(index);
    return {};
  }
  if (std::optional<Contradiction> found = contradictionIn(first, disc)) return found;
  return contradictionIn(first + 1, disc);
}

/// Looks closely at a short piece whose thickness varies: the thickness is taken as linear between the corners.
std::optional<WallSearch::Contradiction> WallSearch::hiddenContradictionIn(uint32_t index, const Disc& disc) {
  const double thin = kThinShare * disc.limit, thinner = kTaperShare * disc.diameter;
  const std::array<double, 3>& values = pieces_.atCornersOf(index);
  const ThinPiece& piece = pieces_[index];
  const PlaneTriangle triangle{piece.corners, pieces_.normal(piece.face)};
  if (piece.least.ball.diameter < thinner)
    if (const auto point = nearestBelow(triangle, {values[0], values[1], values[2]}, thinner, disc.point);
        point && length(*point - disc.point) <= kTaperReach * disc.limit)
      return Contradiction{*point, piece.face, thinner / kSlack, true};
  if (piece.greatest >= thin)
    if (const auto point = nearestBelow(triangle, {-values[0], -values[1], -values[2]}, -thin, disc.point);
        point && length(*point - disc.point) <= kThinReach * disc.limit)
      return Contradiction{*point, piece.face, thin, false};
  return {};
}

/// The surface ends at a rim, where it turns to the other side of the wall.
std::optional<WallSearch::Contradiction> WallSearch::rimNear(uint32_t face, const Disc& disc) const {
  const TraceScene& scene = pieces_.tree().scene();
  const PointFans& fans = pieces_.fans();
  const PlaneTriangle triangle = triangleOf(scene, face);
  const Vec3d& normal = pieces_.normal(disc.face);
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d &a = triangle.corners[k], edge = triangle.corners[(k + 1) % 3] - a;
    const double square = dot(edge, edge);
    if (square == 0) continue;
    const Vec3d nearest = a + std::clamp(dot(disc.point - a, edge) / square, 0.0, 1.0) * edge;
    if (length(nearest - disc.point) > kThinReach * disc.limit) continue;
    const uint32_t end = fans.pointOf(scene.mesh.faces[face][(k + 1) % 3]);
    bool goesOn = false, turns = false;
    for (const uint32_t corner : fans.cornersAt(fans.pointOf(scene.mesh.faces[face][k]))) {
      const uint32_t other = corner / 3;
      const auto hasEnd = [&](uint32_t vertex) { return fans.pointOf(vertex) == end; };
      if (other == face || std::none_of(scene.mesh.faces[other].begin(), scene.mesh.faces[other].end(), hasEnd))
        continue;
      const bool isSameSide =
          scene.geometry.isDegenerate(other) || dot(normal, pieces_.normal(other)) > kSameSideCosine;
      (isSameSide ? goesOn : turns) = true;
    }
    if (turns && !goesOn) return Contradiction{nearest, face, pieces_.limit(), false};
  }
  return {};
}

uint32_t WallSearch::halvesOf(uint32_t piece) {
  const uint32_t first = pieces_.halvesOf(piece);
  if (isExcluded_.size() < pieces_.size()) isExcluded_.resize(pieces_.size(), isExcluded_[piece]);
  return first;
}

void WallSearch::exclude(const Contradiction& contradiction, double floor) {
  const double radius = (contradiction.isThinner ? kTaperReach : kThinReach) * limit_;
  forEachFaceAround(contradiction.point, contradiction.face, radius, [&](uint32_t face, const Vec3d&, double) {
    if (const uint32_t root = pieces_.rootOf(face); root != kNoPiece) excludePieces(root, contradiction, floor);
    return true;
  });
}

/// Whether a contradiction holds for all points of a piece and all limits from `floor`. A point is a wall only at limits
/// above its thickness.
bool WallSearch::isExcludedBy(const Contradiction& contradiction, const ThinPiece& piece, double floor) const {
  const double least = piece.least.ball.diameter;
  const bool holds = contradiction.isThinner ? contradiction.diameter < kTaperShare * least
                                             : contradiction.diameter >= pieces_.limit();
  const double share = contradiction.isThinner ? kTaperReach : kThinReach;
  return holds && farthestCorner(piece, contradiction.point) <= share * std::max(least, floor);
}

void WallSearch::excludePieces(uint32_t index, const Contradiction& contradiction, double floor) {
  if (isExcluded_[index] != 0) return;
  const ThinPiece& piece = pieces_[index];
  if (contradiction.isThinner && contradiction.diameter >= kTaperShare * piece.greatest) return;
  if (isExcludedBy(contradiction, piece, floor)) {
    markExcluded(index);
    return;
  }
  const double size = piece.longestSide().second;
  if (piece.firstHalf == kNoPiece || size <= kPointSpacing * limit_) return;
  if (length(piece.corners[0] - contradiction.point) > size + kTaperReach * limit_) return;
  for (const uint32_t half : {piece.firstHalf, piece.firstHalf + 1}) excludePieces(half, contradiction, floor);
}

void WallSearch::markExcluded(uint32_t index) {
  if (std::exchange(isExcluded_[index], 1) != 0 || pieces_[index].firstHalf == kNoPiece) return;
  if (pieces_[index].longestSide().second <= kPointSpacing * limit_) return;
  for (const uint32_t half : {pieces_[index].firstHalf, pieces_[index].firstHalf + 1}) markExcluded(half);
}

Vec3d WallSearch::pointAwayFrom(const Contradiction& contradiction, const Vec3d& point, uint32_t index,
                                double limit) const {
  const ThinPiece& piece = pieces_[index];
  const Vec3d away = point - contradiction.point;
  const double distance = length(away);
  const double reach = (contradiction.isThinner ? kTaperReach : kThinReach) * limit * (1 + kStepBeyond);
  if (distance == 0) return point;
  return nearestPoint({piece.corners, pieces_.normal(piece.face)}, point + (reach - distance) / distance * away);
}

void WallSearch::forEachFaceAround(const Vec3d& point, uint32_t start, double radius,
                                   FunctionRef<bool(uint32_t, const Vec3d&, double)> visit) {
  const TraceScene& scene = pieces_.tree().scene();
  const PointFans& fans = pieces_.fans();
  const Vec3d& normal = pieces_.normal(start);
  ++walkCount_;
  queue_.assign(1, start);
  visits_[start] = walkCount_;
  for (size_t i = 0; i < queue_.size(); ++i) {
    const uint32_t face = queue_[i];
    if (!scene.geometry.isDegenerate(face)) {
      if (!(dot(normal, pieces_.normal(face)) > kSameSideCosine)) continue;
      const Vec3d nearest = nearestPoint(triangleOf(scene, face), point);
      const double distance = length(nearest - point);
      if (distance > radius) continue;
      if (!visit(face, nearest, distance)) return;
    }
    for (const uint32_t vertex : scene.mesh.faces[face])
      for (const uint32_t corner : fans.cornersAt(fans.pointOf(vertex)))
        if (std::exchange(visits_[corner / 3], walkCount_) != walkCount_) queue_.push_back(corner / 3);
  }
}

}  // namespace asdfvk
