#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/lane_bvh.h"
#include "core/simd.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Rays and their hits. Coordinates are normalised; origins are in the normalised box or near it.
struct RayGroup {
  /// With eight rays, the next step of a ray would begin before its prefetched block arrives. `active` has 32 bits.
  static constexpr size_t kWidth = 32;
  static_assert(kWidth <= 32 && kWidth % kBvhLaneCount == 0);
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

/// Traces groups of rays. Eight boxes or eight triangles are tested against one ray (Wald et al. 2008). The rays of a
/// group take turns. While the data of one ray are fetched from memory, other rays compute. Watertight: no ray passes
/// between triangles with a common edge. The hit of a ray depends neither on other rays nor on the instruction set: of
/// equally near triangles, the lowest primitive is hit. Use one object per thread.
class RayWalk {
 public:
  /// scene: may be null. If a triangle is long and narrow as seen from the origin, a distance that is computed from its
  /// corners is inexact. With a scene, the distance is computed from the plane of the triangle. Hierarchy and scene
  /// must outlive this object. Precondition: this machine has the instruction set.
  explicit RayWalk(const LaneBvh& bvh, const TraceScene* scene = nullptr,
                   InstructionSet instructionSet = widestInstructionSet())
      : bvh_(bvh), scene_(scene), instructionSet_(instructionSet) {}

  /// Finds the nearest hit of each active ray.
  void findNearest(RayGroup& rays);
  /// Finds any one hit of each active ray.
  void findAny(RayGroup& rays);

  /// The nodes and blocks that are still to be tested, and the distances at which the ray enters them; below them, an
  /// entry that marks the end.
  struct Stack {
    std::array<float, kLaneStackSize + 1> distances;
    std::array<uint32_t, kLaneStackSize + 1> references;

    /// The reference of the entry with this distance.
    [[nodiscard]] uint32_t* referenceOf(const float* distance) {
      return references.data() + (distance - distances.data());
    }
  };

 private:
  template <bool kEndsAtAnyHit>
  void trace(RayGroup& rays);

  const LaneBvh& bvh_;
  const TraceScene* scene_;
  InstructionSet instructionSet_;
  std::array<Stack, RayGroup::kWidth> stacks_;  // One stack per ray.
};

}  // namespace asdfvk
