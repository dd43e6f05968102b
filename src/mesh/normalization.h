#pragma once

#include <algorithm>
#include <limits>

#include "core/box3.h"

namespace asdfvk {

/// Maps the mesh's box into [-1, 1]^3 around its centre, by a power of two, so that float32 resolves a mesh equally
/// well whatever its unit and its distance from the origin.
struct Normalization {
  Vec3d centre;
  double scale = 1;  ///< Normalised units per mesh unit; a power of two, so that scaling by it rounds nothing.

  [[nodiscard]] Vec3d toNormalized(const Vec3d& p) const { return (p - centre) * scale; }
  /// At most a double's largest number: only a mesh as wide as a double's range has longer lengths in it.
  [[nodiscard]] double toMeshLength(double normalizedLength) const {
    return std::min(normalizedLength / scale, std::numeric_limits<double>::max());
  }
};

[[nodiscard]] Normalization normalizationOf(const Box3d& bounds);

}  // namespace asdfvk
