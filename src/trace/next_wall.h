#pragma once

#include <span>

#include "asdf_vk/run_control.h"
#include "core/function_ref.h"
#include "trace/thin_regions.h"

namespace asdfvk {

/// Quick: gives up where the search would take longer than a check usually does.
enum class NextWallEffort { Quick, Full };

/// The wall at the least limit from `first` to `last` at which the surface has a wall. least: #F, the least thickness
/// of each face (normalised); NaN for a face that is not judged or that no wall opposes. ballsOf(face): its balls.
/// Throws Error{Cancelled}.
[[nodiscard]] LeastLimit findNextWall(const WallTree& tree, const PointFans& fans, std::span<const double> least,
                                      FunctionRef<FaceBalls(uint32_t)> ballsOf, double first, double last,
                                      NextWallEffort effort, const RunControl& control);

/// Pieces are divided until their sides are at most as long as the larger of limit / kPiecesPerLimit and
/// kMinPieceLength (normalised).
inline constexpr double kPiecesPerLimit = 4, kMinPieceLength = 0x1p-10;

}  // namespace asdfvk
