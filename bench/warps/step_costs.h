#pragma once

#include "warps/warp_counts.h"

namespace asdfvk::bench {

// Instructions of the two inner loops of shaders/trace/trace_rays.comp, with outputs of hits and the stack in memory,
// as RADV of Mesa 22.3.6 compiles them for Navi 21. One iteration is one step of WarpCounts.
inline constexpr StepCosts kCostsAtOnce{260, 118};
inline constexpr StepCosts kCostsPostponed{275, 245};  ///< Two triangles per step.

[[nodiscard]] constexpr const StepCosts& stepCosts(const WarpSchedule& schedule) {
  return schedule.postponesTriangles ? kCostsPostponed : kCostsAtOnce;
}

}  // namespace asdfvk::bench
