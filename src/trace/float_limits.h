#pragma once

#include <cmath>
#include <cstdint>

#include "trace/cone_tracer.h"

namespace asdfvk {

// In normalised units. A face smaller than the first, or a diameter shorter than the second, is too near to what
// float32 resolves (2^-24 at the rim of the box): tracers that work in it leave such a cone to the reference.
inline constexpr double kSmallestFloatFace = 0x1p-16;
inline constexpr double kShortestFloatDiameter = 0x1p-14;

[[nodiscard]] inline bool isTooSmallForFloat(const TraceScene& scene, uint32_t seedFace) {
  return std::sqrt(scene.geometry.areas[seedFace]) * scene.bvh.normalization.scale < kSmallestFloatFace;
}

}  // namespace asdfvk
