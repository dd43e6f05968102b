#include "trace/next_wall.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "trace/wall_rule.h"

namespace asdfvk {
namespace {

/// Each limit is this factor of the limit before.
constexpr double kStep = 2;
/// Number of visited faces per limit, of which about a million take a second.
constexpr size_t kQuickWork = 500'000, kFullWork = std::numeric_limits<size_t>::max();

}  // namespace

LeastLimit findNextWall(const WallTree& tree, const PointFans& fans, std::span<const double> least,
                        FunctionRef<FaceBalls(uint32_t)> ballsOf, double first, double last, NextWallEffort effort,
                        const RunControl& control) {
  LeastLimit found;
  for (double low = first; found.isKnown && !found.wall && low < last; low *= kStep) {
    const double limit = std::min(kStep * low, last), thin = kThinShare * limit;
    std::vector<FaceBalls> faces;
    for (const Wall& each : tree.walls())
      if (least[each.face] < thin) faces.push_back(ballsOf(each.face));
    ThinPieces pieces(tree, fans, faces, thin);
    found = findLeastLimit(pieces, limit, first, effort == NextWallEffort::Full ? kFullWork : kQuickWork, control);
  }
  return found;
}

}  // namespace asdfvk
