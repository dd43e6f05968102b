#include "trace/next_wall.h"

#include <algorithm>
#include <vector>

#include "trace/wall_rule.h"

namespace asdfvk {
namespace {

/// Each limit is this factor of the limit before.
constexpr double kStep = 2;

}  // namespace

LeastLimit findNextWall(const WallTree& tree, const PointFans& fans, std::span<const double> least,
                        FunctionRef<FaceBalls(uint32_t)> ballsOf, double first, double last, size_t maxWork,
                        const RunControl& control) {
  LeastLimit found;
  for (double low = first; found.isKnown && !found.wall && low < last; low *= kStep) {
    const double limit = std::min(kStep * low, last), thin = kThinShare * limit;
    std::vector<FaceBalls> faces;
    for (const Wall& each : tree.walls())
      if (least[each.face] < thin) faces.push_back(ballsOf(each.face));
    ThinPieces pieces(tree, fans, faces, thin);
    found = findLeastLimit(pieces, limit, first, maxWork, control);
  }
  return found;
}

}  // namespace asdfvk
