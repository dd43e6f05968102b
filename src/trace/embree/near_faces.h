#pragma once

#include <array>
#include <span>

#include "core/simd.h"
#include "trace/cone_tracer.h"
#include "trace/embree/slot_planes.h"

namespace asdfvk {

/// A point on the triangle of a slot.
struct SlotPoint {
  Vec3d point;
  uint32_t slot = 0;
};

/// For each of up to eight points, best neighbours, whether a triangle other than that of its slot comes as near to it
/// as `radius`; true also for some that only nearly do. All in normalised units.
[[nodiscard]] std::array<bool, 8> haveNeighboursWithin(const TraceScene& scene, std::span<const SlotPlane> planes,
                                                       std::span<const SlotPoint> points, double radius,
                                                       InstructionSet instructionSet = widestInstructionSet());

}  // namespace asdfvk
