#include "trace/next_wall.h"

#include <algorithm>
#include <vector>

#include "trace/wall_rule.h"

namespace asdfvk {
namespace {

/// Each limit is this factor of the limit before.
constexpr double kStep = 2;

}  // namespace

LeastLimit findNextWall(const WallTree& tree, const PointFans& fans, std::span<const double> least, double first,
                        double last, const RunControl& control) {
  LeastLimit found;
  for (double low = first; found.isKnown && !found.wall && low < last; low *= kStep) {
    const double limit = std::min(kStep * low, last), thin = kThinShare * limit;
    std::vector<FaceBalls> faces;
    for (const Wall& each : tree.walls())
      if (least[each.face] < thin) {
        faces.push_back({each.face, {}, {}});
        faces.back().atBarycentre.ball.diameter = faces.back().least.ball.diameter = thin;
      }
    shrinkFaceBalls(tree, faces, control);
    ThinPieces pieces(tree, fans, faces, thin);
    pieces.divide(std::max(low / kPiecesPerLimit, kMinPieceLength), control);
    found = findLeastLimit(pieces, limit, first, control);
  }
  return found;
}

}  // namespace asdfvk
