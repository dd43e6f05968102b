#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// Eight floats computed side by side (vector extensions of GCC and Clang): compilers leave loops of this length with
/// comparisons in them to one float at a time. Each lane is rounded as a float is, whatever the machine's width.
namespace asdfvk {

inline constexpr size_t kLaneCount = 8;

using Lanes = float __attribute__((vector_size(kLaneCount * sizeof(float))));
/// All bits of a lane set or none; masks combine by &, and `mask ? a : b` chooses lane by lane.
using LaneMask = int32_t __attribute__((vector_size(kLaneCount * sizeof(int32_t))));

/// numbers: kLaneCount of them.
inline void load(Lanes& lanes, const float* numbers) { std::memcpy(&lanes, numbers, sizeof lanes); }
inline void load(LaneMask& lanes, const uint32_t* numbers) { std::memcpy(&lanes, numbers, sizeof lanes); }
inline void store(float* numbers, const Lanes& lanes) { std::memcpy(numbers, &lanes, sizeof lanes); }

inline void squareRoot(Lanes& result, const Lanes& of) {
  float roots[kLaneCount];
  store(roots, of);
  for (float& root : roots) root = std::sqrt(root);
  load(result, roots);
}

/// Lane 0 first.
[[nodiscard]] inline float sumOverLanes(const Lanes& lanes) {
  float sum = 0;
  for (size_t lane = 0; lane < kLaneCount; ++lane) sum += lanes[lane];
  return sum;
}

}  // namespace asdfvk
