#pragma once

#include <vector>

#include "trace/cone_tracer.h"

namespace asdfvk {

/// The plane of a triangle slot in normalised coordinates: normal * p = offset. 32 bytes, all that is asked of a
/// triangle once a ray has met it.
struct SlotPlane {
  Vec3d normal;  ///< Unit.
  double offset = 0;
};
static_assert(sizeof(SlotPlane) == 32);

/// One per slot of the hierarchy.
[[nodiscard]] std::vector<SlotPlane> slotPlanes(const TraceScene& scene);

}  // namespace asdfvk
