#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/point_fans.h"
#include "trace/face_balls.h"
#include "trace/sharp_edges.h"

namespace asdfvk {

/// A thin part of a face in normalised coordinates: the whole face, or a triangle of it.
struct ThinPart {
  uint32_t face = 0;
  std::array<Vec3d, 3> corners;
  /// The least ball over the part. The ball has no wall if the greatest section limits its diameter.
  InscribedBall least;
  bool isThinAtMiddle = false;
  bool isSharp = false;  ///< Whether the part contains a point of a sharp edge or tip.
  uint32_t region = 0;   ///< Number of the region; parts connected over edges are one region.
};

/// The parts of thin faces that have a point below the limit. Pieces of faces are halved at their longest edges. A
/// piece is not halved if its edges are at most maxLength long, or if one wall shows that the piece is thin everywhere.
/// faces: thin faces with their balls; at least one ball of each face is below the limit. Throws Error{Cancelled}.
[[nodiscard]] std::vector<ThinPart> findThinParts(const WallTree& tree, const PointFans& fans, const SharpEdges& sharp,
                                                  std::span<const FaceBalls> faces, double limit, double maxLength,
                                                  const RunControl& control);

}  // namespace asdfvk
