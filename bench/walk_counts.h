#pragma once

#include <cstdint>
#include <span>

#include "bvh/device_bvh.h"
#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// What the walks of shaders/binary_walk.glsl and wide_walk.glsl meet, per ray.
struct WalkCounts {
  double nodes = 0, triangles = 0;
  /// For the wide one: the same per ray where eight rays with the same place in the cones of seeds that are neighbours
  /// in `seeds` take every step together, as the lanes of a subgroup do.
  double sharedNodes = 0, sharedTriangles = 0;
};

/// Of the cones of the seed faces, counted on the CPU in double precision.
[[nodiscard]] WalkCounts countWalks(const DeviceBvh& bvh, const TraceScene& scene, const Cone& cone,
                                    std::span<const uint32_t> seeds);

}  // namespace asdfvk::bench
