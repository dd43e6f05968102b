#pragma once

#include <cstdint>
#include <span>

#include "bvh/device_bvh.h"
#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// Number of seeds whose rays share every step: the lanes of a subgroup.
inline constexpr size_t kNeighbourCount = 8;

/// Nodes and triangles that the walks of shaders/binary_walk.glsl and wide_walk.glsl visit, on average.
struct WalkCounts {
  double nodes = 0, triangles = 0;  ///< Per ray.
  /// Per group of kNeighbourCount rays that share every step: the rays at the same place in the cones of consecutive
  /// seeds. Each step costs as much as the ray that needs most.
  double sharedNodes = 0, sharedTriangles = 0;
};

/// Counts on the CPU in double precision. The seeds form groups of kNeighbourCount consecutive ones; a remainder is
/// skipped.
[[nodiscard]] WalkCounts countWalks(const DeviceBvh& bvh, const TraceScene& scene, const Cone& cone,
                                    std::span<const uint32_t> seeds);

}  // namespace asdfvk::bench
