#pragma once

#include <numbers>

#include "core/elementary.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

// The rule that decides which thin places are walls (docs/thickness.md). L is the limit.

/// A point is thin if its thickness is below this share of L, because files round 0.8 to 0.79992.
inline constexpr double kThinShare = 0.999;
/// All points of the surface around a wall are thin, as far as this share of L.
inline constexpr double kThinReach = 1.0 / 3;
/// No point of the surface around a wall, as far as the share kTaperReach of L, is thinner than the share kTaperShare
/// of the thickness of the wall.
inline constexpr double kTaperReach = 3.0 / 8, kTaperShare = 7.0 / 8;
/// The surface around a point has normals that differ by less than 107 degrees from the normal at the point. It
/// contains the surface behind a right angle, but not the other side of a wall.
inline const double kSameSideCosine = cosine(107 * std::numbers::pi / 180);
/// Details have limits of at least this share of L.
inline constexpr double kLeastDetailShare = 1.0 / 16;
/// A thickness of at most this number is 0, because float32 does not resolve it (normalised). Thus the thickness at a
/// sharp edge is 0: the ball there is as small as the resolution allows.
inline constexpr double kUnresolved = 2 * kContactDistance;

}  // namespace asdfvk
