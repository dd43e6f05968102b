#include "trace/thin_regions.h"

#include <algorithm>
#include <tuple>

#include "core/disjoint_sets.h"
#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

struct Side {
  uint32_t line = 0, from = 0, to = 0, piece = 0;  // from < to
  double length = 0;
};

class Regions {
 public:
  Regions(ThinPieces& pieces, double limit, std::span<const uint32_t> bodyOf = {})
      : pieces_(pieces), limit_(limit), bodyOf_(bodyOf) {
    for (uint32_t i = 0; i < pieces.size(); ++i)
      if (pieces.isThin(i) && pieces[i].firstHalf == kNoPiece) leaves_.push_back(i);
  }

  [[nodiscard]] const std::vector<uint32_t>& leaves() const { return leaves_; }

  std::vector<ConnectedThinParts> run(const RunControl& control) {
    connect();
    WallSearch search(pieces_, limit_);
    std::vector<ConnectedThinParts> regions(piecesOf_.size());
    for (size_t i = 0; i < regions.size(); ++i) {
      control.checkpoint(0.5);
      regions[i] = describe(piecesOf_[i], search);
      regions[i].perimeter = perimeters_[i];
    }
    joinSides(regions);
    return regions;
  }

 private:
  [[nodiscard]] std::vector<Side> sidesOfLeaves() const {
    std::vector<Side> sides;
    sides.reserve(3 * leaves_.size());
    for (uint32_t i = 0; i < leaves_.size(); ++i) {
      const ThinPiece& piece = pieces_[leaves_[i]];
      for (size_t k = 0; k < 3; ++k) {
        const LinePart& side = piece.sides[k];
        sides.push_back({side.line, std::min(side.from, side.to), std::max(side.from, side.to), i,
                         length(piece.corners[(k + 1) % 3] - piece.corners[k])});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tuple(a.line, a.from, a.to, a.piece) < std::tuple(b.line, b.from, b.to, b.piece);
    });
    return sides;
  }

  /// The body of the wall of a leaf.
  [[nodiscard]] uint32_t wallBodyOf(uint32_t leaf) const {
    const uint32_t wall = pieces_[leaves_[leaf]].least.wall;
    return bodyOf_.empty() || wall == kNoFace ? kNoBody : bodyOf_[wall];
  }

  /// Pieces are neighbours if their sides overlap on a line. A side without a neighbour belongs to the border.
  void connect() {
    const std::vector<Side> sides = sidesOfLeaves();
    std::vector<uint8_t> isInner(sides.size());
    DisjointSets sets(leaves_.size());
    for (size_t i = 1, reaching = 0; i < sides.size(); ++i) {
      const Side &farthest = sides[reaching], &other = sides[i];
      if (other.line == farthest.line && other.from < farthest.to) {
        if (wallBodyOf(farthest.piece) == wallBodyOf(other.piece)) {
          sets.join(farthest.piece, other.piece);
          isInner[reaching] = isInner[i] = 1;
        }
        if (other.to <= farthest.to) continue;
      }
      reaching = i;
    }
    regionOf_.resize(leaves_.size());
    for (uint32_t i = 0; i < leaves_.size(); ++i) {
      const uint32_t lowest = sets.lowestOf(i);
      if (lowest == i) piecesOf_.emplace_back();
      regionOf_[i] = lowest == i ? static_cast<uint32_t>(piecesOf_.size() - 1) : regionOf_[lowest];
      piecesOf_[regionOf_[i]].push_back(leaves_[i]);
    }
    perimeters_.resize(piecesOf_.size());
    for (size_t i = 0; i < sides.size(); ++i)
      if (isInner[i] == 0) perimeters_[regionOf_[sides[i].piece]] += sides[i].length;
  }

  [[nodiscard]] ConnectedThinParts describe(const std::vector<uint32_t>& ofRegion, WallSearch& search) const {
    ConnectedThinParts region;
    region.parts.reserve(ofRegion.size());
    for (const uint32_t i : ofRegion)
      region.parts.push_back({pieces_[i].face, pieces_[i].corners, pieces_[i].atMiddle < pieces_.limit()});
    const uint32_t thinnest = *std::min_element(ofRegion.begin(), ofRegion.end(), [&](uint32_t a, uint32_t b) {
      return std::pair(pieces_[a].least.ball.diameter, a) < std::pair(pieces_[b].least.ball.diameter, b);
    });
    const InscribedBall& least = pieces_[thinnest].least;
    region.leastPlace = {pieces_[thinnest].face, least, limit_};
    if (const std::optional<WallPlace> wall = search.leastWall(ofRegion)) {
      region.kind = ThinKind::Wall;
      region.place = *wall;
    } else if (const std::optional<WallPlace> detail = search.findDetail(ofRegion)) {
      region.kind = ThinKind::Detail;
      region.place = *detail;
    } else {
      region.place = region.leastPlace;
    }
    return region;
  }

  /// The region of the point that the ball of a place touches on the opposing wall; its own number if there is none.
  [[nodiscard]] uint32_t regionOpposite(const std::vector<ConnectedThinParts>& regions, uint32_t own) const {
    const InscribedBall& ball = regions[own].place.ball;
    if (ball.wall == kNoFace) return own;
    const Vec3d& touched = ball.ball.onWall;
    for (auto i = std::lower_bound(byFace_.begin(), byFace_.end(), std::pair(ball.wall, 0U));
         i != byFace_.end() && i->first == ball.wall; ++i) {
      const ThinPiece& piece = pieces_[leaves_[i->second]];
      if (length(nearestPoint({piece.corners, pieces_.normal(piece.face)}, touched) - touched) <= kContactDistance)
        return regionOf_[i->second];
    }
    return own;
  }

  void joinSides(std::vector<ConnectedThinParts>& regions) {
    for (uint32_t i = 0; i < leaves_.size(); ++i) byFace_.emplace_back(pieces_[leaves_[i]].face, i);
    std::sort(byFace_.begin(), byFace_.end());
    std::vector<uint32_t> opposite(regions.size());
    for (uint32_t i = 0; i < regions.size(); ++i) opposite[i] = regionOpposite(regions, i);
    for (uint32_t i = 0; i < regions.size(); ++i)
      if (opposite[i] > i && opposite[opposite[i]] == i) takeSide(regions[i], regions[opposite[i]]);
    std::erase_if(regions, [](const ConnectedThinParts& region) { return region.parts.empty(); });
  }

  static void takeSide(ConnectedThinParts& region, ConnectedThinParts& side) {
    region.parts.insert(region.parts.end(), side.parts.begin(), side.parts.end());
    side.parts.clear();
    region.perimeter += side.perimeter;
    const auto rank = [](const ConnectedThinParts& each) {
      return std::pair(each.kind, each.place.ball.ball.diameter);
    };
    if (rank(side) < rank(region)) {
      region.kind = side.kind;
      region.place = side.place;
    }
    if (side.leastPlace.ball.ball.diameter < region.leastPlace.ball.ball.diameter) region.leastPlace = side.leastPlace;
  }

  ThinPieces& pieces_;
  double limit_;
  std::span<const uint32_t> bodyOf_;
  std::vector<uint32_t> leaves_, regionOf_;            // Thin pieces that are not halved, and their regions.
  std::vector<std::vector<uint32_t>> piecesOf_;        // The pieces of each region.
  std::vector<double> perimeters_;                     // One entry per region.
  std::vector<std::pair<uint32_t, uint32_t>> byFace_;  // Faces and leaves.
};

}  // namespace

std::vector<ConnectedThinParts> findThinRegions(ThinPieces& pieces, double limit, std::span<const uint32_t> bodyOf,
                                                const RunControl& control) {
  return Regions(pieces, limit, bodyOf).run(control);
}

LeastLimit findLeastLimit(ThinPieces& pieces, double limit, double floor, size_t maxWork, const RunControl& control) {
  return WallSearch(pieces, limit).leastLimit(Regions(pieces, limit).leaves(), floor, maxWork, control);
}

}  // namespace asdfvk
