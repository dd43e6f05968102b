#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "trace/thin_pieces.h"
#include "trace/wall_search.h"

namespace asdfvk {

/// A thin part of a face in normalised coordinates: the whole face, or a triangle of it.
struct ThinPart {
  uint32_t face = 0;
  std::array<Vec3d, 3> corners;
  bool isThinAtMiddle = false;
};

/// Connected thin parts of the surface, on both sides of a wall. Lengths are normalised.
struct ConnectedThinParts {
  std::vector<ThinPart> parts;
  ThinKind kind = ThinKind::Edge;
  WallPlace place;       ///< The least wall or a detail; for an edge the point of the least ball.
  WallPlace leastPlace;  ///< The point of the least ball of all parts.
  double perimeter = 0;  ///< Length of the border of the parts.
};

/// The thin regions at a limit. pieces: divided pieces; receives diameters at corners. Two sides belong to one region
/// if the place of each side is opposite to the other side. bodyOf: #F, the body of each face; empty if all faces are
/// of one body. Thin parts belong to different regions if their walls are of different bodies. Throws
/// Error{Cancelled}.
[[nodiscard]] std::vector<ConnectedThinParts> findThinRegions(ThinPieces& pieces, double limit,
                                                              std::span<const uint32_t> bodyOf,
                                                              const RunControl& control);

/// The wall at the least limit from `floor` to `limit`. pieces: divided or not.
/// maxWork: see WallSearch::leastLimit().
[[nodiscard]] LeastLimit findLeastLimit(ThinPieces& pieces, double limit, double floor, size_t maxWork,
                                        const RunControl& control);

}  // namespace asdfvk
