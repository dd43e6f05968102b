#pragma once

#include <limits>
#include <span>

#include "asdf_vk/run_control.h"
#include "core/function_ref.h"
#include "trace/thin_regions.h"

namespace asdfvk {

/// Largest work per limit, see WallSearch::leastLimit(): about half a second, and a search to the end.
inline constexpr size_t kQuickNextWall = 500'000, kFullNextWall = std::numeric_limits<size_t>::max();

/// The wall at the least limit from `first` to `last` at which the surface has a wall. least: #F, the least thickness
/// of each face (normalised); NaN for a face that is not judged or that no wall opposes. ballsOf(face): its balls.
/// Throws Error{Cancelled}.
[[nodiscard]] LeastLimit findNextWall(const WallTree& tree, const PointFans& fans, std::span<const double> least,
                                      FunctionRef<FaceBalls(uint32_t)> ballsOf, double first, double last,
                                      size_t maxWork, const RunControl& control);

}  // namespace asdfvk
