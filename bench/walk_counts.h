#pragma once

#include <cstdint>
#include <span>

#include "bvh/device_bvh.h"
#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// As many rays take every step together where a subgroup walks.
inline constexpr size_t kNeighbourCount = 8;

/// What the walks of shaders/binary_walk.glsl and wide_walk.glsl meet, per ray; the second tests two triangles at a
/// time.
struct WalkCounts {
  double nodes = 0, triangles = 0;
  /// For the wide one: the same per ray where kNeighbourCount rays with the same place in the cones of seeds that are
  /// neighbours in `seeds` take every step together, as the lanes of a subgroup do.
  double sharedNodes = 0, sharedTriangles = 0;
};

/// Of the cones of the seed faces, the first kNeighbourCount of them together, then the next, the rest left out;
/// counted on the CPU in double precision.
[[nodiscard]] WalkCounts countWalks(const DeviceBvh& bvh, const TraceScene& scene, const Cone& cone,
                                    std::span<const uint32_t> seeds);

}  // namespace asdfvk::bench
