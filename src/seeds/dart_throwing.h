#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/surface_distances.h"

namespace asdfvk {

/// The radius takes this many values, at even steps, from each power of two to the next: it shrinks by 1 to 2 % at
/// once.
inline constexpr uint32_t kRadiiPerOctave = 64;

struct ThrownDarts {
  std::vector<uint32_t> faces;  ///< In the order thrown.
  /// The start radius gave them all and would have given more: they may fill only a part of the surface.
  bool leaveGaps = false;
};

/// Hierarchical dart throwing (McCool and Fiume, "Hierarchical Poisson disk sampling distributions", 1992) on the dual
/// graph: at each radius every waiting face, in turn, becomes a dart unless one is nearer than the radius; then the
/// radius shrinks. Unlike there a face waits with the radius that its distance from the darts allows and is not looked
/// at in between, so that fine steps of the radius cost no more than coarse ones.
///
/// waiting: the faces that may become darts, in the order in which they shall be tried. count: at most their number.
/// startRadius: kShortestArc or more; infinite makes farthest points of the darts.
/// distances: of the seeds that are there, known up to the start radius; the darts are added.
[[nodiscard]] ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius,
                                     SurfaceDistances& distances);

}  // namespace asdfvk
