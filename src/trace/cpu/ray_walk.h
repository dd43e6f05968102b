#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/lane_bvh.h"
#include "core/simd.h"
#include "trace/triangle_planes.h"

namespace asdfvk {

/// Eight rays, side by side, and their hits. Coordinates are normalised; origins are in the normalised box or near it.
struct RayGroup {
  static constexpr size_t kWidth = 8;
  using Floats = std::array<float, kWidth>;
  using Indices = std::array<uint32_t, kWidth>;

  uint32_t active = 0;  ///< A bit for each ray to trace.
  /// Rows: x, y, z. The unit of distances is the length of the direction.
  alignas(32) std::array<Floats, 3> origins{}, directions{};
  alignas(32) Floats begins{}, ends{};  ///< Hits are at distances from `begins` to `ends`, both finite.
  alignas(32) Indices skipped{};        ///< The primitive whose hits are ignored.
  float outerSideAddition = 0;  ///< Added to the distance of a hit on the outer side of a face (kOuterSideFactor).

  alignas(32) Floats distances{};    ///< Infinite without a hit. Float32 resolves coordinates of the corners to 2^-24.
  alignas(32) Indices primitives{};  ///< kNoFace without a hit.
};

/// Traces groups of rays. Eight boxes or eight triangles are tested against one ray (Wald et al. 2008), and the rays of
/// a group take turns, so that each waits for its memory while others compute. Watertight: no ray passes between
/// triangles with a common edge. The hit of a ray depends on no other ray and on no instruction set: of equally near
/// triangles it is the one with the lowest primitive. Use one object per thread.
class RayWalk {
 public:
  /// planes: one per primitive, or empty. The corners of a triangle that looks long and narrow from the origin give an
  /// inexact distance; with planes, its distance is computed from its plane. Hierarchy and planes must outlive this
  /// object. Precondition: this machine has the instruction set.
  explicit RayWalk(const LaneBvh& bvh, std::span<const TrianglePlane> planes = {},
                   InstructionSet instructionSet = widestInstructionSet())
      : bvh_(bvh), planes_(planes), instructionSet_(instructionSet) {}

  /// Sets distances and primitives of the active rays to the nearest hits.
  void findNearest(RayGroup& rays);
  /// Sets distances and primitives of the active rays to any one hit each.
  void findAny(RayGroup& rays);

  /// The nodes and blocks that a ray still has to test, and the distances at which the ray enters them.
  struct Stack {
    std::array<float, kLaneStackSize> distances;
    std::array<uint32_t, kLaneStackSize> references;
  };

 private:
  template <bool kEndsAtAnyHit>
  void trace(RayGroup& rays);

  const LaneBvh& bvh_;
  std::span<const TrianglePlane> planes_;
  InstructionSet instructionSet_;
  std::array<Stack, RayGroup::kWidth> stacks_;  // Per ray.
};

}  // namespace asdfvk
