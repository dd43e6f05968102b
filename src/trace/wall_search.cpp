#include "trace/wall_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>

#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// Number of points per part. If a point is not a wall, the next point is farther from the contradiction.
constexpr int kPointsPerPart = 3;
/// Number of parts that are halved at a time, so that their halves fill the lanes of one traversal of the hierarchy.
constexpr size_t kPartsPerQuery = 8;
/// Largest number of limits that are tried at a point.
constexpr int kLimitsPerPoint = 8;
/// Each limit is at least this factor of the limit before, except for the greatest limit.
constexpr double kLimitStep = 1 + 1.0 / 32;
/// Number of tested points after which the search for the least wall ends with the least one found, and number of
/// points at which a detail is looked for.
constexpr size_t kMaxPointsForLeast = 2000, kMaxPointsForDetail = 500;
/// A tested point takes as long as visiting this number of faces.
constexpr size_t kPointWork = 8;
/// Number of contradictions per cell that are kept.
constexpr size_t kContradictionsPerCell = 8;
/// Walls are as thick as each other within this relative difference.
constexpr double kEqualWalls = 2e-3;
constexpr double kAboveThickness = 1 + 1e-9;
/// A point is moved beyond the reach of a contradiction by this share.
constexpr double kStepBeyond = 1.0 / 64;
/// Shares of the limit: the greatest length of parts whose middle stands for their points, and the size of the cells of
/// which one point is tested.
constexpr double kPointSpacing = 0.36, kCellSize = 1.0 / 4;
/// Parts that are at most this long are not halved, which bounds the work if the limit is far below the size of the
/// shape (normalised).
constexpr double kMinPartSize = 0x1p-11;

/// The number of a cell of a grid, shifted by some cells along each axis.
uint64_t cellOf(const Vec3d& point, double size, const std::array<int, 3>& shift = {}) {
  uint64_t key = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    key = key << 21 ^ (static_cast<uint64_t>(std::floor((point[axis] + 2) / size) + shift[axis]) & 0x1fffff);
  return key;
}

/// One of six directions.
uint64_t directionOf(const Vec3d& normal) {
  size_t axis = 0;
  for (const size_t other : {size_t{1}, size_t{2}})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  return axis << 1 | (normal[axis] < 0 ? 1 : 0);
}

WallPlace placeOf(const SurfacePointDisc& disc) { return {disc.face, disc.ball, disc.limit}; }

double reachOf(const Contradiction& contradiction) { return contradiction.isThinner ? kTaperReach : kThinReach; }

}  // namespace

WallSearch::WallSearch(ThinPieces& pieces, double limit)
    : pieces_(pieces), limit_(limit), scale_(limit), check_(pieces) {}

std::optional<WallPlace> WallSearch::leastWall(std::span<const uint32_t> pieces) {
  std::optional<WallPlace> best;
  const auto isDone = [&](double least) {
    return best && (pointCount_ > kMaxPointsForLeast || least >= best->ball.ball.diameter / (1 + kEqualWalls));
  };
  forEachPoint(pieces, limit_, isDone, [&](const SurfacePointDisc& disc) {
    if (!best || disc.diameter() < best->ball.ball.diameter) best = placeOf(disc);
  });
  return best;
}

LeastLimit WallSearch::leastLimit(std::span<const uint32_t> pieces, double floor, size_t maxWork,
                                  const RunControl& control) {
  const auto isTooLong = [&] {
    control.checkpoint(0.5);
    return check_.work() + kPointWork * pointCount_ > maxWork;
  };
  std::optional<WallPlace> best;
  const auto isDone = [&](double least) {
    return isTooLong() || (best && std::max(floor, least / kThinShare) >= best->limit / (1 + kEqualWalls));
  };
  forEachPoint(pieces, floor, isDone, [&](const SurfacePointDisc& disc) {
    if (!best || disc.limit < best->limit) best = placeOf(disc);
  });
  if (isTooLong()) return {{}, false};
  return {best};
}

std::optional<WallPlace> WallSearch::findDetail(std::span<const uint32_t> pieces) {
  std::optional<WallPlace> detail;
  for (scale_ = limit_; !detail && scale_ > kLeastDetailShare * limit_; scale_ /= 2)
    forEachPoint(
        pieces, scale_ / 2, [&](double) { return detail || pointCount_ > kMaxPointsForDetail; },
        [&](const SurfacePointDisc& disc) { detail = placeOf(disc); });
  scale_ = limit_;
  return detail;
}

/// Looks for points that are walls at a limit from `floor` to scale_. Parts are tested by ascending least thickness.
/// visit(disc) receives each such point with the least of these limits. The search ends if isDone(least thickness of
/// the parts that remain) is true.
void WallSearch::forEachPoint(std::span<const uint32_t> pieces, double floor, FunctionRef<bool(double)> isDone,
                              FunctionRef<void(const SurfacePointDisc&)> visit) {
  cells_.clear();
  contradictions_.clear();
  pointCount_ = 0;
  // Parts of equal thickness: long ones first, then those that were found first. A total order, because libraries
  // differ in the order of equal elements.
  const auto isLater = [](const Part& a, const Part& b) {
    return std::tuple(a.least, -a.size, a.number) > std::tuple(b.least, -b.size, b.number);
  };
  std::priority_queue<Part, std::vector<Part>, decltype(isLater)> queue(isLater);
  uint32_t partCount = 0;
  const auto add = [&](Part part) {
    part.number = partCount++;
    queue.push(part);
  };
  for (const uint32_t i : pieces) {
    const ThinPiece& piece = pieces_[i];
    if (piece.least.ball.diameter < kThinShare * scale_)
      add({piece.corners, pieces_.ballAtMiddle(i), piece.least.ball.diameter, longestSideOf(piece.corners).second,
           piece.face});
  }
  std::vector<Part> longParts;
  while (true) {
    if (longParts.size() == kPartsPerQuery || queue.empty() || isDone(queue.top().least)) {
      if (longParts.empty() || isDone(longParts.front().least)) break;
      for (const Part& half : measuredHalvesOf(longParts))
        if (half.least < kThinShare * scale_) add(half);
      longParts.clear();
      continue;
    }
    const Part part = queue.top();
    queue.pop();
    if (isExcluded(part, floor)) continue;
    testPoints(part, floor, visit);
    if (!isShort(part) && !isDone(part.least) && !isExcluded(part, floor)) longParts.push_back(part);
  }
}

/// Whether one point stands for all points of a part.
bool WallSearch::isShort(const Part& part) const { return part.size <= std::max(kPointSpacing * scale_, kMinPartSize); }

void WallSearch::testPoints(const Part& part, double floor, FunctionRef<void(const SurfacePointDisc&)> visit) {
  SurfacePointDisc disc{part.face, middleOf(part.corners), part.atMiddle, 0};
  const Vec3d& normal = pieces_.normal(part.face);
  if (isShort(part) && !cells_.insert(cellOf(disc.point, kCellSize * scale_) ^ directionOf(normal) << 61).second)
    return;
  for (int i = 0; i < kPointsPerPart; ++i) {
    ++pointCount_;
    if (i > 0) disc.ball = pieces_.ballAt(disc.face, disc.point, disc.ball.wall);
    const std::optional<Contradiction> contradiction = contradictionFrom(disc, floor);
    if (!contradiction) return visit(disc);
    keep(*contradiction);
    if (contradiction->isThinner || excludes(*contradiction, part, floor)) return;
    const Vec3d away = disc.point - contradiction->point;
    const double distance = length(away), reach = reachOf(*contradiction) * disc.limit * (1 + kStepBeyond);
    if (distance == 0) return;
    disc.point = nearestPoint({part.corners, normal}, disc.point + (reach - distance) / distance * away);
  }
}

std::vector<WallSearch::Part> WallSearch::measuredHalvesOf(std::span<const Part> parts) const {
  std::vector<BallQuery> queries;
  for (const Part& part : parts)
    for (const std::array<Vec3d, 3>& half : halvesOf(part.corners, longestSideOf(part.corners).first))
      queries.push_back(
          pieces_.queryAt(part.face, half, middleOf(half), pieces_.limit(), {part.atMiddle.wall, kNoFace}));
  pieces_.tree().shrink(queries);
  std::vector<Part> halves;
  for (const BallQuery& query : queries) {
    const std::array<Vec3d, 3>& corners = query.triangle.corners;
    halves.push_back({corners, query.atPoint, query.least.ball.diameter, longestSideOf(corners).second,
                      parts[halves.size() / 2].face, 0});
  }
  return halves;
}

/// Sets disc.limit to the least limit from `floor` to scale_ at which the point is a wall. If there is none, returns a
/// contradiction. The disc of a greater limit contains the disc of a smaller one: a thicker point contradicts until the
/// limit is above its thickness, a thinner point always.
std::optional<Contradiction> WallSearch::contradictionFrom(SurfacePointDisc& disc, double floor) {
  disc.limit = std::min(std::max(disc.diameter() / kThinShare * kAboveThickness, floor), scale_);
  std::optional<Contradiction> contradiction;
  for (int i = 0; i < kLimitsPerPoint && disc.limit <= scale_; ++i) {
    contradiction = check_.contradictionAt(disc);
    if (!contradiction || contradiction->isThinner || contradiction->diameter >= kThinShare * scale_) break;
    disc.limit =
        std::max(contradiction->diameter / kThinShare * (1 + kEqualWalls), std::min(disc.limit * kLimitStep, scale_));
  }
  return contradiction;
}

/// Whether a contradiction holds for all points of a part and all limits from `floor`. A point is a wall only at limits
/// above its thickness.
bool WallSearch::excludes(const Contradiction& contradiction, const Part& part, double floor) const {
  const bool holds = contradiction.isThinner ? contradiction.diameter < kTaperShare * part.least
                                             : contradiction.diameter >= kThinShare * scale_;
  if (!holds || !(dot(pieces_.normal(contradiction.face), pieces_.normal(part.face)) > kSameSideCosine)) return false;
  const double reach = reachOf(contradiction) * std::max(part.least, floor);
  return std::all_of(part.corners.begin(), part.corners.end(),
                     [&](const Vec3d& corner) { return length(corner - contradiction.point) <= reach; });
}

bool WallSearch::isExcluded(const Part& part, double floor) const {
  const double cell = kTaperReach * scale_;
  if (part.size > 2 * cell) return false;
  for (int i = 0; i < 27; ++i) {
    const auto found =
        contradictions_.find(cellOf(middleOf(part.corners), cell, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}));
    if (found == contradictions_.end()) continue;
    for (const Contradiction& contradiction : found->second)
      if (excludes(contradiction, part, floor)) return true;
  }
  return false;
}

void WallSearch::keep(const Contradiction& contradiction) {
  std::vector<Contradiction>& ofCell = contradictions_[cellOf(contradiction.point, kTaperReach * scale_)];
  if (ofCell.size() < kContradictionsPerCell) ofCell.push_back(contradiction);
}

}  // namespace asdfvk
