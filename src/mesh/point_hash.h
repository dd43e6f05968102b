#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/vec3.h"

namespace asdfvk {

/// A hash of the point's bits: the finalizer of SplitMix64 over each number in turn. -0 and 0 differ.
[[nodiscard]] inline uint64_t hashOf(const Vec3d& point) {
  uint64_t h = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    h = (h ^ std::bit_cast<uint64_t>(point[axis])) + 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return h;
}

}  // namespace asdfvk
