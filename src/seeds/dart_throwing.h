#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "seeds/surface_distances.h"

namespace asdfvk {

/// Number of radii from each power of two to the next, evenly spaced: the radius decreases in steps of 1 to 2 %.
inline constexpr uint32_t kRadiiPerOctave = 64;

struct ThrownDarts {
  std::vector<uint32_t> faces;  ///< The seeds, in the order of their selection.
  /// Whether all darts were found at the start radius. If true, more darts would fit, and a part of the surface may be
  /// without darts.
  bool leaveGaps = false;
};

/// Hierarchical dart throwing (McCool and Fiume, "Hierarchical Poisson disk sampling distributions", 1992) on the dual
/// graph. At each radius, the candidate faces are tested in order. A face becomes a dart if its distance to every dart
/// is at least the radius. Then the radius decreases. Difference from the paper: a face is skipped until the radius is
/// at most its distance to the darts. Therefore small steps of the radius take no more time than large steps.
///
/// waiting: the candidate faces, in order. count: at most their number.
/// startRadius: kMinArcLength or more; infinity gives farthest-point sampling.
/// distances: the distances to the existing seeds, exact up to the start radius; unspecified after the call.
/// Throws Error{Cancelled}.
[[nodiscard]] ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius,
                                     SurfaceDistances& distances, const RunControl& stopOnly = {});

}  // namespace asdfvk
