#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "asdf_vk/run_control.h"
#include "core/function_ref.h"
#include "trace/surface_disc.h"
#include "trace/thin_pieces.h"

namespace asdfvk {

/// A point of the surface that is thin: the point TouchingBall::onFace of the ball. Normalised.
struct WallPlace {
  uint32_t face = kNoFace;
  InscribedBall ball;
  double limit = 0;  ///< The least known limit at which the point is a wall.
};

/// The wall at the least limit, unset if there is none; or a search that gave up.
struct LeastLimit {
  std::optional<WallPlace> wall;
  bool isKnown = true;
};

/// Finds walls and details among thin pieces, by the rule of wall_rule.h. Triangles of the surface are visited by
/// ascending thickness. The middle of a triangle is a wall, or a point near it contradicts. In the second case the
/// search goes on farther away from this point, which may also exclude triangles around it. Long triangles are halved.
class WallSearch {
 public:
  /// limit: the limit L, normalised. Precondition: the limit of the pieces is kThinShare * limit.
  WallSearch(ThinPieces& pieces, double limit);

  /// The least wall among the given pieces; unset if none is a wall.
  [[nodiscard]] std::optional<WallPlace> leastWall(std::span<const uint32_t> pieces);
  /// The wall at the least limit from `floor` to the limit L. The search ends without a result if its work exceeds
  /// `maxWork`. Work is a number of visited faces (DiscCheck::work()), and a share for each tested point. Throws
  /// Error{Cancelled}.
  [[nodiscard]] LeastLimit leastLimit(std::span<const uint32_t> pieces, double floor, size_t maxWork,
                                      const RunControl& control);
  /// A detail among the pieces that have no wall.
  [[nodiscard]] std::optional<WallPlace> findDetail(std::span<const uint32_t> pieces);

 private:
  /// A part of a piece. Diameters as in ThinPiece.
  struct Part {
    std::array<Vec3d, 3> corners;
    InscribedBall atMiddle;
    double least = 0, size = 0;
    uint32_t face = kNoFace;
    uint32_t number = 0;  ///< Ascending in the order of the queue.
  };

  void forEachPoint(std::span<const uint32_t> pieces, double floor, FunctionRef<bool(double)> isDone,
                    FunctionRef<void(const SurfacePointDisc&)> visit);
  void testPoints(const Part& part, double floor, FunctionRef<void(const SurfacePointDisc&)> visit);
  [[nodiscard]] std::vector<Part> measuredHalvesOf(std::span<const Part> parts) const;
  [[nodiscard]] std::optional<Contradiction> contradictionFrom(SurfacePointDisc& disc, double floor);
  [[nodiscard]] bool excludes(const Contradiction& contradiction, const Part& part, double floor) const;
  [[nodiscard]] bool isExcluded(const Part& part, double floor) const;
  void keep(const Contradiction& contradiction);
  [[nodiscard]] bool isShort(const Part& part) const;

  ThinPieces& pieces_;
  double limit_;
  double scale_;  // Greatest limit of the points that are looked for.
  DiscCheck check_;
  std::unordered_set<uint64_t> cells_;  // Cells that contain a tested point.
  std::unordered_map<uint64_t, std::vector<Contradiction>> contradictions_;
  size_t pointCount_ = 0;  // Number of tested points.
};

}  // namespace asdfvk
