#include "trace/thin_parts.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Largest number of pieces into which faces are divided. A piece takes 350 bytes. Whole faces are not counted.
constexpr size_t kMaxPieceCount = size_t{1} << 20;
constexpr size_t kBlockSize = 256;
/// Length of a line in steps: a power of two, so that halves are exact.
constexpr uint32_t kLineLength = uint32_t{1} << 31;

/// A part of a line. The line is an edge of the mesh, or a line along which a piece was halved.
struct Side {
  uint32_t line = 0, from = 0, to = 0;
  bool isSharp = false;  ///< Whether the line is a sharp edge of the face.
};

struct Piece {
  ThinPart part;
  InscribedBall atMiddle;
  std::array<Side, 3> sides;  ///< Side k runs from corner k to the next corner.
};

Vec3d middleOf(const std::array<Vec3d, 3>& corners) { return (corners[0] + corners[1] + corners[2]) / 3.0; }

std::pair<size_t, double> longestSide(const std::array<Vec3d, 3>& corners) {
  std::pair<size_t, double> longest{0, -1};
  for (size_t k = 0; k < 3; ++k)
    if (const double side = length(corners[(k + 1) % 3] - corners[k]); side > longest.second) longest = {k, side};
  return longest;
}

class ThinSearch {
 public:
  ThinSearch(const WallTree& tree, const PointFans& fans, const SharpEdges& sharp, double limit, double maxLength)
      : tree_(tree), fans_(fans), sharp_(sharp), limit_(limit), maxLength_(maxLength) {}

  std::vector<ThinPart> run(std::span<const FaceBalls> faces, const RunControl& control) {
    std::vector<Piece> divided;
    for (const FaceBalls& balls : faces) {
      Piece piece = pieceOf(balls);
      (mustDivide(piece) ? divided : finished_).push_back(std::move(piece));
    }
    while (!divided.empty()) {
      control.checkpoint(0.5);
      std::vector<Piece> halves;
      halves.reserve(2 * divided.size());
      for (const Piece& piece : divided) halve(piece, halves);
      measure(halves);
      divided.clear();
      const bool mayDivide = finished_.size() + 2 * halves.size() < kMaxPieceCount;
      for (Piece& piece : halves) {
        if (!isThin(piece)) continue;
        (mayDivide && mustDivide(piece) ? divided : finished_).push_back(std::move(piece));
      }
    }
    std::stable_sort(finished_.begin(), finished_.end(),
                     [](const Piece& a, const Piece& b) { return a.part.face < b.part.face; });
    connect();
    std::vector<ThinPart> parts;
    parts.reserve(finished_.size());
    for (Piece& piece : finished_) parts.push_back(std::move(piece.part));
    return parts;
  }

 private:
  Piece pieceOf(const FaceBalls& balls) {
    const uint32_t face = balls.face;
    Piece piece{{face, triangleOf(tree_.scene(), face).corners, balls.least, false, false, 0}, balls.atBarycentre, {}};
    for (size_t k = 0; k < 3; ++k) {
      const Face& vertices = tree_.scene().mesh.faces[face];
      const uint32_t a = fans_.pointOf(vertices[k]), b = fans_.pointOf(vertices[(k + 1) % 3]);
      const auto [edge, isNew] = edges_.try_emplace(std::pair(std::min(a, b), std::max(a, b)), lineCount_);
      lineCount_ += isNew ? 1 : 0;
      const uint32_t from = a < b ? 0 : kLineLength;
      piece.sides[k] = {edge->second, from, kLineLength - from, sharp_.hasEdge(face, k)};
    }
    describe(piece);
    return piece;
  }

  void describe(Piece& piece) const {
    piece.part.isThinAtMiddle = piece.atMiddle.ball.diameter < limit_;
    piece.part.isSharp = isSharp(piece);
  }

  /// Pieces at a sharp edge are thin, whatever the diameters of their balls.
  [[nodiscard]] bool isThin(const Piece& piece) const {
    return piece.part.isSharp || piece.part.least.ball.diameter < limit_;
  }

  [[nodiscard]] bool isSharp(const Piece& piece) const {
    for (const Side& side : piece.sides)
      if (side.isSharp) return true;
    const std::array<Vec3d, 3> corners = triangleOf(tree_.scene(), piece.part.face).corners;
    for (size_t k = 0; k < 3; ++k)
      if (sharp_.hasCorner(piece.part.face, k) &&
          std::find(piece.part.corners.begin(), piece.part.corners.end(), corners[k]) != piece.part.corners.end())
        return true;
    return false;
  }

  [[nodiscard]] bool mustDivide(const Piece& piece) const {
    if (piece.part.least.wall == kNoFace) return false;
    return longestSide(piece.part.corners).second > maxLength_ && !isThinEverywhere(piece);
  }

  /// If one wall limits the balls, the diameter is a convex function of the point. If the diameter is then below the
  /// limit at the corners, it is below the limit everywhere between them.
  [[nodiscard]] bool isThinEverywhere(const Piece& piece) const {
    const Vec3d& normal = tree_.scene().geometry.normals[piece.part.face];
    for (const uint32_t face : {piece.part.least.wall, piece.atMiddle.wall}) {
      if (face == kNoFace) continue;
      const PlaneTriangle wall = triangleOf(tree_.scene(), face);
      const auto isThinAt = [&](const Vec3d& corner) {
        return leastTouchingBall(corner, normal, wall, kContactDistance, limit_).diameter < limit_;
      };
      if (std::all_of(piece.part.corners.begin(), piece.part.corners.end(), isThinAt)) return true;
    }
    return false;
  }

  void halve(const Piece& piece, std::vector<Piece>& halves) {
    const size_t k = longestSide(piece.part.corners).first, next = (k + 1) % 3, opposite = (k + 2) % 3;
    const std::array<Vec3d, 3>& corners = piece.part.corners;
    const Vec3d middle = 0.5 * (corners[k] + corners[next]);
    const Side &side = piece.sides[k], cut{lineCount_++, 0, kLineLength, false};
    const uint32_t halfway = side.from / 2 + side.to / 2;
    const auto add = [&](const std::array<Vec3d, 3>& half, const std::array<Side, 3>& sides) {
      halves.push_back({{piece.part.face, half, {}, false, false, 0}, {}, sides});
    };
    add({corners[k], middle, corners[opposite]},
        {Side{side.line, side.from, halfway, side.isSharp}, cut, piece.sides[opposite]});
    add({middle, corners[next], corners[opposite]},
        {Side{side.line, halfway, side.to, side.isSharp}, piece.sides[next], Side{cut.line, cut.to, cut.from, false}});
  }

  void measure(std::span<Piece> pieces) const {
    forEachTask((pieces.size() + kBlockSize - 1) / kBlockSize, [&](size_t block) {
      const size_t first = block * kBlockSize;
      const std::span<Piece> own = pieces.subspan(first, std::min(kBlockSize, pieces.size() - first));
      std::vector<BallQuery> queries(own.size());
      for (size_t i = 0; i < own.size(); ++i) {
        const ThinPart& part = own[i].part;
        queries[i] = {{part.corners, tree_.scene().geometry.normals[part.face]},
                      middleOf(part.corners),
                      {},
                      {},
                      tree_.bodyOf(part.face)};
        queries[i].atPoint.ball.diameter = queries[i].least.ball.diameter = limit_;
      }
      tree_.shrink(queries);
      for (size_t i = 0; i < own.size(); ++i) {
        own[i].part.least = queries[i].least;
        own[i].atMiddle = queries[i].atPoint;
        describe(own[i]);
      }
    });
  }

  /// Numbers the regions. Pieces are neighbours if their sides overlap on a line.
  void connect() {
    struct Reference {
      uint32_t line, from, to, piece;
    };
    std::vector<Reference> references;
    references.reserve(3 * finished_.size());
    for (uint32_t i = 0; i < finished_.size(); ++i)
      for (const Side& side : finished_[i].sides)
        references.push_back({side.line, std::min(side.from, side.to), std::max(side.from, side.to), i});
    std::sort(references.begin(), references.end(), [](const Reference& a, const Reference& b) {
      return std::tuple(a.line, a.from, a.to, a.piece) < std::tuple(b.line, b.from, b.to, b.piece);
    });
    DisjointSets regions(finished_.size());
    for (size_t i = 1, reaching = 0; i < references.size(); ++i) {
      const Reference &farthest = references[reaching], &other = references[i];
      if (other.line == farthest.line && other.from < farthest.to) {
        regions.join(farthest.piece, other.piece);
        if (other.to <= farthest.to) continue;
      }
      reaching = i;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < finished_.size(); ++i) {
      const uint32_t lowest = regions.lowestOf(i);
      finished_[i].part.region = lowest == i ? count++ : finished_[lowest].part.region;
    }
  }

  const WallTree& tree_;
  const PointFans& fans_;
  const SharpEdges& sharp_;
  double limit_, maxLength_;
  /// Maps the two end points of a mesh edge, in ascending order, to the number of its line (Side::line).
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges_;
  uint32_t lineCount_ = 0;
  std::vector<Piece> finished_;
};

}  // namespace

std::vector<ThinPart> findThinParts(const WallTree& tree, const PointFans& fans, const SharpEdges& sharp,
                                    std::span<const FaceBalls> faces, double limit, double maxLength,
                                    const RunControl& control) {
  return ThinSearch(tree, fans, sharp, limit, maxLength).run(faces, control);
}

}  // namespace asdfvk
