#pragma once

#include <cstdint>

#include "bvh/bvh.h"
#include "shared/cone_hit.h"
#include "trace/ray_triangle.h"

namespace asdfvk {

struct RayHit {
  double distance = kNoHit;  ///< In normalised units.
  uint32_t face = kNoFace;   ///< kNoFace for a miss.
};

/// The nearest triangle of the hierarchy that the ray meets, other than `skippedFace`; the lowest face among equally
/// near ones. Origin and unit direction are in normalised coordinates; the origin lies in the root's box or near it.
[[nodiscard]] RayHit nearestHit(const Bvh& bvh, const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& direction,
                                uint32_t skippedFace);

}  // namespace asdfvk
