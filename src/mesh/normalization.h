#pragma once

#include <algorithm>
#include <limits>

#include "core/box3.h"

namespace asdfvk {

/// Maps the box of the mesh into [-1, 1]^3 around its centre, scaled by a power of two, so that the resolution of
/// float32 does not depend on the unit of the mesh and its distance from the origin.
struct Normalization {
  Vec3d centre;
  double scale = 1;  ///< Normalised units per mesh unit; a power of two, so that scaling is exact.

  [[nodiscard]] Vec3d toNormalized(const Vec3d& p) const { return (p - centre) * scale; }
  /// At most the largest double, which only meshes as wide as the range of double would exceed.
  [[nodiscard]] double toMeshLength(double normalizedLength) const {
    return std::min(normalizedLength / scale, std::numeric_limits<double>::max());
  }
};

[[nodiscard]] Normalization normalizationOf(const Box3d& bounds);

}  // namespace asdfvk
