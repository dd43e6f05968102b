#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "asdf_vk/run_control.h"
#include "core/function_ref.h"
#include "trace/thin_regions.h"

namespace asdfvk {

/// The work of a search to the end, see WallSearch::leastLimit().
inline constexpr size_t kFullNextWall = std::numeric_limits<size_t>::max();
/// Work per limit that takes about as long as the check for a limit.
[[nodiscard]] constexpr size_t quickNextWall(size_t faceCount) {
  return std::min<size_t>(500'000, 100'000 + 50 * faceCount);
}

/// The wall at the least limit from `first` to `last` at which the surface has a wall. least: #F, the least thickness
/// of each face (normalised); NaN for a face that is not judged or that no wall opposes. ballsOf(face): its balls.
/// Throws Error{Cancelled}.
[[nodiscard]] LeastLimit findNextWall(const WallTree& tree, const PointFans& fans, std::span<const double> least,
                                      FunctionRef<FaceBalls(uint32_t)> ballsOf, double first, double last,
                                      size_t maxWork, const RunControl& control);

}  // namespace asdfvk
