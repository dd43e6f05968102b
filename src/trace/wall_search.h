#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "core/function_ref.h"
#include "trace/thin_pieces.h"
#include "trace/wall_rule.h"

namespace asdfvk {

/// A point of the surface that is a wall at a limit.
struct WallPlace {
  uint32_t face = kNoFace;
  Vec3d point;  ///< Normalised.
  InscribedBall ball;
  double limit = 0;  ///< The least limit of a detail that was found; normalised.
};

/// Finds walls and details among thin pieces, by the rule of wall_rule.h. Pieces are visited by ascending thickness. The
/// middle of a piece is a wall, or a point near it contradicts. In the second case the search goes on farther away from
/// this point, which also excludes the pieces around it. Longer pieces are halved. Halves pieces, and therefore runs on
/// one thread.
class WallSearch {
 public:
  /// limit: the limit L, normalised. Precondition: the limit of the pieces is kThinShare * limit.
  WallSearch(ThinPieces& pieces, double limit);

  /// The least wall among the given pieces; unset if none is a wall.
  [[nodiscard]] std::optional<WallPlace> leastWall(std::span<const uint32_t> pieces);
  /// The wall at the least limit from `floor` to the limit L, and this limit.
  [[nodiscard]] std::optional<WallPlace> leastLimit(std::span<const uint32_t> pieces, double floor);
  /// A detail among the pieces that have no wall.
  [[nodiscard]] std::optional<WallPlace> findDetail(std::span<const uint32_t> pieces);

 private:
  /// A point that shows that another point is not a wall.
  struct Contradiction {
    Vec3d point;
    uint32_t face = kNoFace;
    double diameter = 0;
    bool isThinner = false;  ///< Below kTaperShare of the other point; else not thin.
  };
  /// A point with the diameter of its ball, and a limit at which it may be a wall.
  struct Disc {
    uint32_t face = kNoFace;
    Vec3d point;
    double diameter = 0, limit = 0;
  };

  void forEachPoint(std::span<const uint32_t> pieces, double floor, FunctionRef<bool(uint32_t)> isDone,
                    FunctionRef<void(const Disc&)> visit);
  [[nodiscard]] std::optional<Contradiction> contradictionFrom(Disc& disc, double floor);
  [[nodiscard]] std::optional<Contradiction> contradictionAt(const Disc& disc);
  [[nodiscard]] std::optional<Contradiction> contradictionIn(uint32_t piece, const Disc& disc);
  [[nodiscard]] std::optional<Contradiction> hiddenContradictionIn(uint32_t piece, const Disc& disc);
  [[nodiscard]] std::optional<Contradiction> rimNear(uint32_t face, const Disc& disc) const;
  [[nodiscard]] bool isExcludedBy(const Contradiction& contradiction, const ThinPiece& piece, double floor) const;
  void exclude(const Contradiction& contradiction, double floor);
  void excludePieces(uint32_t piece, const Contradiction& contradiction, double floor);
  void markExcluded(uint32_t piece);
  uint32_t halvesOf(uint32_t piece);
  /// Visits the faces connected to `face` that are at most `radius` away from `point`, on the same side, near ones
  /// first. visit(face, nearest point, distance) returns whether the walk goes on.
  void forEachFaceAround(const Vec3d& point, uint32_t face, double radius,
                         FunctionRef<bool(uint32_t, const Vec3d&, double)> visit);
  [[nodiscard]] Vec3d pointAwayFrom(const Contradiction& contradiction, const Vec3d& point, uint32_t piece,
                                    double reach) const;

  ThinPieces& pieces_;
  double limit_;
  std::vector<uint8_t> isExcluded_;  // One entry per piece.
  std::vector<uint32_t> visits_;     // #F, number of the last walk that visited the face.
  std::vector<uint32_t> queue_, uncertain_;
  std::unordered_set<uint64_t> cells_;  // Cells that contain a tested point.
  uint32_t walkCount_ = 0;
};

}  // namespace asdfvk
