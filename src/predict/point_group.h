#pragma once

#include <cstddef>
#include <cstdint>

#include "core/lanes.h"

namespace asdfvk {

/// As many points as lanes are computed side by side, in normalised units. All arrays have one entry per point.
struct alignas(64) PointGroup {
  float x[kLaneCount], y[kLaneCount], z[kLaneCount];     ///< Where; NaN for a ray that met nothing, and for padding.
  float nx[kLaneCount], ny[kLaneCount], nz[kLaneCount];  ///< The unit normal there.
  float spread[kLaneCount];   ///< The surface that the point stands for, over the solid angle of a cone's ray.
  float kept[kLaneCount];     ///< 1 where the seed's own outlier rule keeps the ray, else 0.
  uint32_t face[kLaneCount];  ///< The face hit.
};

/// The points of one cone: a run of groups.
struct PointCone {
  uint32_t firstGroup = 0, groupCount = 0;
  float typicalLength = 0;  ///< The median of its valid lengths; 0 where there is none.
};

/// A cone that a face looks at.
struct WeighedCone {
  uint32_t firstGroup = 0, groupCount = 0;
  float weight = 0;  ///< How much its points count, above 0.
};

}  // namespace asdfvk
