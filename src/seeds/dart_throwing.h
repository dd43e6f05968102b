#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/surface_distances.h"

namespace asdfvk {

struct DartRadii {
  float start = SurfaceDistances::kUnreached;  ///< Positive.
  /// The radius takes 2^stepBits values from each power of two to the next: those of a float cut to so many bits of its
  /// mantissa, so that the step of a distance is read off its bits.
  uint32_t stepBits = 3;
};

struct ThrownDarts {
  std::vector<uint32_t> faces;  ///< In the order thrown.
  float lastRadius = 0;         ///< No dart is nearer than this to an earlier one or to a seed that was there.
  /// The first radius sufficed, so that the darts may fill only a part of the surface.
  bool endedAtStart = false;
};

/// Hierarchical dart throwing (McCool and Fiume, "Hierarchical Poisson disk sampling distributions", 1992) on the dual
/// graph: at each radius every waiting face, in turn, becomes a dart unless one is nearer than the radius; then the
/// radius shrinks. Unlike there a face waits with the radius that its distance from the darts allows and is not looked
/// at in between, so that the number of radii costs nothing.
///
/// waiting: the faces that may become darts, in the order in which they shall be tried. count: at most their number.
/// distances: of the seeds that are there, known up to the start radius; the darts are added.
[[nodiscard]] ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, const DartRadii& radii,
                                     SurfaceDistances& distances);

}  // namespace asdfvk
