#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/surface_distances.h"

namespace asdfvk {

/// Number of radii from each power of two to the next, evenly spaced: the radius decreases in steps of 1 to 2 %.
inline constexpr uint32_t kRadiiPerOctave = 64;

struct ThrownDarts {
  std::vector<uint32_t> faces;  ///< The seeds, in the order of their selection.
  /// Whether all darts were found at the start radius. More darts would then fit, and a part of the surface may have
  /// none.
  bool leaveGaps = false;
};

/// Hierarchical dart throwing (McCool and Fiume, "Hierarchical Poisson disk sampling distributions", 1992) on the dual
/// graph. At each radius every candidate face, in order, becomes a dart if its distance to every dart is at least the
/// radius. Then the radius decreases. Difference from the paper: a face is skipped until the radius is at most its
/// distance to the darts, so that small steps of the radius cost no more than large ones.
///
/// waiting: the candidate faces, in order. count: at most their number.
/// startRadius: kMinArcLength or more; infinity gives farthest-point sampling.
/// distances: the distances to the existing seeds, exact up to the start radius; unspecified after the call.
[[nodiscard]] ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius,
                                     SurfaceDistances& distances);

}  // namespace asdfvk
