#include "trace/thin_pieces.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Largest number of halves. A piece takes 300 bytes.
constexpr size_t kMaxHalfCount = size_t{1} << 20;
constexpr size_t kBlockSize = 256;
/// Length of a line in steps: a power of two, so that halves are exact.
constexpr uint32_t kLineLength = uint32_t{1} << 31;

}  // namespace

std::pair<size_t, double> longestSideOf(const std::array<Vec3d, 3>& corners) {
  std::pair<size_t, double> longest{0, -1};
  for (size_t k = 0; k < 3; ++k)
    if (const double side = length(corners[(k + 1) % 3] - corners[k]); side > longest.second) longest = {k, side};
  return longest;
}

std::array<std::array<Vec3d, 3>, 2> halvesOf(const std::array<Vec3d, 3>& corners, size_t side) {
  const Vec3d &from = corners[side], &to = corners[(side + 1) % 3], &opposite = corners[(side + 2) % 3];
  const Vec3d middle = 0.5 * (from + to);
  return {{{from, middle, opposite}, {middle, to, opposite}}};
}

ThinPieces::ThinPieces(const WallTree& tree, const PointFans& fans, std::span<const FaceBalls> faces, double limit)
    : tree_(tree), fans_(fans), limit_(limit), roots_(tree.scene().mesh.faceCount(), kNoPiece) {
  pieces_.reserve(faces.size());
  for (const FaceBalls& balls : faces) {
    roots_[balls.face] = static_cast<uint32_t>(pieces_.size());
    pieces_.push_back(rootPiece(balls));
  }
  rootCount_ = pieces_.size();
}

ThinPiece ThinPieces::rootPiece(const FaceBalls& balls) {
  const uint32_t face = balls.face;
  ThinPiece piece{.face = face, .corners = triangleOf(tree_.scene(), face).corners, .least = balls.least};
  piece.atMiddle = std::min(balls.atBarycentre.ball.diameter, limit_);
  for (size_t k = 0; k < 3; ++k) {
    const Face& vertices = tree_.scene().mesh.faces[face];
    const uint32_t a = fans_.pointOf(vertices[k]), b = fans_.pointOf(vertices[(k + 1) % 3]);
    const auto [edge, isNew] = edges_.try_emplace(std::pair(std::min(a, b), std::max(a, b)), lineCount_);
    lineCount_ += isNew ? 1 : 0;
    const uint32_t from = a < b ? 0 : kLineLength;
    piece.sides[k] = {edge->second, from, kLineLength - from};
  }
  piece.middleWall = balls.atBarycentre.wall;
  piece.greatest = boundOf(piece);
  return piece;
}

/// If one wall limits the balls, the diameter is a convex function of the point: the diameters at the corners are a
/// bound.
double ThinPieces::boundOf(const ThinPiece& piece) const {
  if (piece.least.ball.diameter == 0) return 0;
  double bound = limit_;
  const auto limitBy = [&](uint32_t face) {
    const PlaneTriangle wall = triangleOf(tree_.scene(), face);
    double greatest = 0;
    for (const Vec3d& corner : piece.corners)
      greatest =
          std::max(greatest, leastTouchingBall(corner, normal(piece.face), wall, kContactDistance, limit_).diameter);
    bound = std::min(bound, greatest);
  };
  if (piece.least.wall != kNoFace) limitBy(piece.least.wall);
  if (piece.middleWall != kNoFace && piece.middleWall != piece.least.wall) limitBy(piece.middleWall);
  return bound;
}

bool ThinPieces::mayHalve() const { return pieces_.size() - rootCount_ < kMaxHalfCount; }

void ThinPieces::divide(double maxLength, const RunControl& control) {
  const auto mustHalve = [&](uint32_t i) {
    return isThin(i) && pieces_[i].greatest >= limit_ && longestSideOf(pieces_[i].corners).second > maxLength;
  };
  for (size_t begin = 0; begin < pieces_.size() && mayHalve();) {
    control.checkpoint(0.5);
    const size_t end = pieces_.size();
    for (size_t i = begin; i < end; ++i)
      if (mustHalve(static_cast<uint32_t>(i))) addHalves(static_cast<uint32_t>(i));
    measure(std::span(pieces_).subspan(end));
    begin = end;
  }
}

uint32_t ThinPieces::addHalves(uint32_t index) {
  const ThinPiece piece = pieces_[index];
  const size_t k = longestSideOf(piece.corners).first, next = (k + 1) % 3, opposite = (k + 2) % 3;
  const std::array<std::array<Vec3d, 3>, 2> halves = halvesOf(piece.corners, k);
  const LinePart &side = piece.sides[k], cut{lineCount_++, 0, kLineLength};
  const uint32_t halfway = side.from / 2 + side.to / 2;
  const auto first = static_cast<uint32_t>(pieces_.size());
  const auto add = [&](const std::array<Vec3d, 3>& half, const std::array<LinePart, 3>& sides) {
    pieces_.push_back({.face = piece.face,
                       .corners = half,
                       .least = {{}, piece.least.wall},
                       .middleWall = piece.middleWall,
                       .sides = sides});
  };
  add(halves[0], {LinePart{side.line, side.from, halfway}, cut, piece.sides[opposite]});
  add(halves[1], {LinePart{side.line, halfway, side.to}, piece.sides[next], LinePart{cut.line, cut.to, cut.from}});
  pieces_[index].firstHalf = first;
  return first;
}

void ThinPieces::measure(std::span<ThinPiece> pieces) const {
  forEachTask((pieces.size() + kBlockSize - 1) / kBlockSize, [&](size_t block) {
    const size_t first = block * kBlockSize;
    const std::span<ThinPiece> own = pieces.subspan(first, std::min(kBlockSize, pieces.size() - first));
    std::vector<BallQuery> queries(own.size());
    for (size_t i = 0; i < own.size(); ++i)
      queries[i] = queryAt(own[i].face, own[i].corners, middleOf(own[i].corners), limit_,
                           {own[i].least.wall, own[i].middleWall});
    tree_.shrink(queries);
    for (size_t i = 0; i < own.size(); ++i) {
      own[i].least = queries[i].least;
      own[i].atMiddle = queries[i].atPoint.ball.diameter;
      own[i].middleWall = queries[i].atPoint.wall;
      own[i].greatest = boundOf(own[i]);
    }
  });
}

void ThinPieces::measureCorners(std::span<const uint32_t> pieces) {
  std::vector<BallQuery> queries;
  std::vector<double*> results;
  for (const uint32_t i : pieces) {
    ThinPiece& piece = pieces_[i];
    if (piece.atCorners[0] > 0) continue;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d& corner = piece.corners[k];
      queries.push_back(queryAt(piece.face, {corner, corner, corner}, corner, kCornerRange * limit_,
                                {piece.least.wall, piece.middleWall}));
      results.push_back(&piece.atCorners[k]);
    }
  }
  tree_.shrink(queries);
  for (size_t i = 0; i < queries.size(); ++i) *results[i] = queries[i].atPoint.ball.diameter;
}

InscribedBall ThinPieces::ballAtMiddle(uint32_t index) const {
  const ThinPiece& piece = pieces_[index];
  const Vec3d middle = middleOf(piece.corners);
  if (piece.middleWall == kNoFace) return {{piece.atMiddle, middle, middle}, kNoFace};
  return {leastTouchingBall(middle, normal(piece.face), triangleOf(tree_.scene(), piece.middleWall), kContactDistance,
                            std::numeric_limits<double>::infinity()),
          piece.middleWall};
}

BallQuery ThinPieces::queryAt(uint32_t face, const std::array<Vec3d, 3>& part, const Vec3d& point, double greatest,
                              const std::array<uint32_t, 2>& hints) const {
  BallQuery query{{part, normal(face)}, point, {}, {}, tree_.bodyOf(face), hints};
  query.atPoint = {{isSheet(face) ? 0 : greatest, point, point}, kNoFace};
  query.least = query.atPoint;
  if (part[0] == part[1] && part[0] == part[2]) query.least.ball.diameter = 0;
  return query;
}

InscribedBall ThinPieces::ballAt(uint32_t face, const Vec3d& point, uint32_t hint) const {
  BallQuery query = queryAt(face, {point, point, point}, point, limit_, {hint, kNoFace});
  tree_.shrink({&query, 1});
  return query.atPoint;
}

}  // namespace asdfvk
