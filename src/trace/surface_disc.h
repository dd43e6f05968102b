#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/function_ref.h"
#include "trace/thin_pieces.h"
#include "trace/wall_rule.h"

namespace asdfvk {

/// A point with its ball, and a limit at which it may be a wall. Its disc is the surface around it. All lengths are
/// normalised.
struct SurfacePointDisc {
  uint32_t face = kNoFace;
  Vec3d point;
  InscribedBall ball;
  double limit = 0;

  [[nodiscard]] double diameter() const { return ball.ball.diameter; }
};

/// A point of a disc that shows that the middle of the disc is not a wall.
struct Contradiction {
  Vec3d point;
  uint32_t face = kNoFace;
  double diameter = 0;
  bool isThinner = false;  ///< Below kTaperShare of the middle, or the end of the surface; else not thin.
};

/// Decides whether points are walls. Faces without pieces are thicker than the limit of the pieces. The thickness of a
/// short piece is taken as linear between its corners. A long piece is clipped to the disc first.
class DiscCheck {
 public:
  explicit DiscCheck(ThinPieces& pieces);

  /// A contradiction, or unset if the middle of the disc is a wall.
  [[nodiscard]] std::optional<Contradiction> contradictionAt(const SurfacePointDisc& disc);
  /// The work so far, as a number of visited faces.
  [[nodiscard]] size_t work() const { return work_; }

 private:
  [[nodiscard]] std::optional<Contradiction> taperAt(const SurfacePointDisc& disc) const;
  [[nodiscard]] std::optional<Contradiction> contradictionIn(uint32_t piece, const SurfacePointDisc& disc);
  [[nodiscard]] std::optional<Contradiction> hiddenContradictionIn(uint32_t piece, const SurfacePointDisc& disc);
  [[nodiscard]] std::optional<Contradiction> contradictionInClipped(uint32_t piece, const SurfacePointDisc& disc) const;
  [[nodiscard]] std::optional<Contradiction> rimNear(uint32_t face, const SurfacePointDisc& disc) const;
  [[nodiscard]] std::optional<Vec3d> nearestOnEdge(uint32_t face, size_t k, const SurfacePointDisc& disc) const;
  void forEachFaceAtEdge(uint32_t face, size_t k, FunctionRef<void(uint32_t)> visit) const;
  void forEachFaceAround(const SurfacePointDisc& disc, FunctionRef<bool(uint32_t, const Vec3d&, double)> visit);

  ThinPieces& pieces_;
  std::vector<uint32_t> visits_;  // #F, number of the last walk that visited the face.
  std::vector<uint32_t> queue_, uncertain_;
  uint32_t walkCount_ = 0;
  mutable size_t work_ = 0;
};

}  // namespace asdfvk
