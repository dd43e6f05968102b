#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/point_fans.h"
#include "trace/face_balls.h"

namespace asdfvk {

inline constexpr uint32_t kNoPiece = 0xffffffff;
/// Diameters at the corners of pieces are at most this factor of the limit, so that they show how the thickness varies
/// near the limit.
inline constexpr double kCornerRange = 2;
/// The pieces of thin regions have sides of at most limit / kPiecesPerLimit, or of kMinPieceLength if this is longer
/// (normalised).
inline constexpr double kPiecesPerLimit = 4, kMinPieceLength = 0x1p-10;

[[nodiscard]] inline Vec3d middleOf(const std::array<Vec3d, 3>& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

/// Index and length of the longest side of a triangle.
[[nodiscard]] std::pair<size_t, double> longestSideOf(const std::array<Vec3d, 3>& corners);

/// The halves of a triangle that is cut from the middle of a side to the opposite corner. The first half contains the
/// first corner of the side.
[[nodiscard]] std::array<std::array<Vec3d, 3>, 2> halvesOf(const std::array<Vec3d, 3>& corners, size_t side);

/// A part of a line. The line is an edge of the mesh, or a line along which a piece was halved.
struct LinePart {
  uint32_t line = 0, from = 0, to = 0;
};

/// A piece of a face in normalised coordinates: the whole face, or a half of a piece. All diameters above the limit of
/// the pieces are replaced by the limit.
struct ThinPiece {
  uint32_t face = 0;
  std::array<Vec3d, 3> corners;
  InscribedBall least;            ///< The least ball over the piece. It has no wall if it is not below the limit.
  double atMiddle = 0;            ///< Diameter of the ball at the middle.
  uint32_t middleWall = kNoFace;  ///< The wall of this ball.
  double greatest = 0;            ///< Upper bound of the diameters of the balls at all points of the piece.
  /// Diameters of the balls at the corners, at most kCornerRange times the limit; 0 before measureCorners().
  std::array<double, 3> atCorners{};
  uint32_t firstHalf = kNoPiece;    ///< The other half follows. kNoPiece for a piece that was not halved.
  std::array<LinePart, 3> sides{};  ///< Side k runs from corner k to the next corner.
};

/// The faces that have a point below a limit, as trees of pieces. A piece is halved at its longest side.
class ThinPieces {
 public:
  /// faces: the faces that have a point below the limit, with their balls; the other faces of the mesh are thicker
  /// everywhere. The arguments must outlive the pieces.
  ThinPieces(const WallTree& tree, const PointFans& fans, std::span<const FaceBalls> faces, double limit);

  /// Halves the pieces that have a point below the limit, until their sides are at most maxLength long, or one wall
  /// shows that they are below the limit everywhere. On all cores. Throws Error{Cancelled}.
  void divide(double maxLength, const RunControl& control);

  /// Measures the diameters at the corners of some pieces, unless they are measured.
  void measureCorners(std::span<const uint32_t> pieces);
  [[nodiscard]] InscribedBall ballAtMiddle(uint32_t piece) const;

  [[nodiscard]] const ThinPiece& operator[](uint32_t piece) const { return pieces_[piece]; }
  [[nodiscard]] size_t size() const { return pieces_.size(); }
  [[nodiscard]] uint32_t rootOf(uint32_t face) const { return roots_[face]; }  ///< kNoPiece for a thicker face.
  [[nodiscard]] bool isThin(uint32_t piece) const { return pieces_[piece].least.ball.diameter < limit_; }
  /// A face of thickness 0: two sheets in contact.
  [[nodiscard]] bool isSheet(uint32_t face) const {
    return roots_[face] != kNoPiece && pieces_[roots_[face]].least.ball.diameter == 0;
  }
  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] const WallTree& tree() const { return tree_; }
  [[nodiscard]] const PointFans& fans() const { return fans_; }
  [[nodiscard]] const Vec3d& normal(uint32_t face) const { return tree_.scene().geometry.normals[face]; }
  /// The query for a part of a face and a point of the part. The diameters are at most `greatest`; 0 on a sheet. If the
  /// part is a single point, the diameter of BallQuery::least is 0, because only the ball at the point is searched.
  [[nodiscard]] BallQuery queryAt(uint32_t face, const std::array<Vec3d, 3>& part, const Vec3d& point, double greatest,
                                  const std::array<uint32_t, 2>& hints) const;
  /// The ball at a point of a face, with a diameter of at most the limit. hint: a wall that is probably near, or
  /// kNoFace.
  [[nodiscard]] InscribedBall ballAt(uint32_t face, const Vec3d& point, uint32_t hint) const;

 private:
  [[nodiscard]] ThinPiece rootPiece(const FaceBalls& balls);
  [[nodiscard]] double boundOf(const ThinPiece& piece) const;
  [[nodiscard]] bool mayHalve() const;
  uint32_t addHalves(uint32_t piece);
  void measure(std::span<ThinPiece> pieces) const;

  const WallTree& tree_;
  const PointFans& fans_;
  double limit_;
  std::vector<ThinPiece> pieces_;
  std::vector<uint32_t> roots_;  // #F
  size_t rootCount_ = 0;
  /// Maps the two end points of a mesh edge, in ascending order, to the number of its line (LinePart::line).
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges_;
  uint32_t lineCount_ = 0;
};

}  // namespace asdfvk
