#pragma once

#include <span>

#include "trace/slot_planes.h"

namespace asdfvk {

/// Whether a triangle other than that of `slot` comes as near to the point as `radius`; true also for some that only
/// nearly do. All in normalised units.
[[nodiscard]] bool hasNeighbourWithin(const TraceScene& scene, std::span<const SlotPlane> planes, const Vec3d& point,
                                      uint32_t slot, double radius);

}  // namespace asdfvk
