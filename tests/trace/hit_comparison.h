#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "shared/cone_hit.h"

namespace asdfvk {

// The absolute error of float32 at coordinates near 1 for grazing rays: applies to distances shorter than 1e-2.
inline constexpr float kResolution = 0x1p-20f;

/// Rays with a different face, or with distances that differ by more than 1e-4 of the distance and kResolution.
inline size_t differingRays(const std::vector<ConeHit>& a, const std::vector<ConeHit>& b) {
  REQUIRE(a.size() == b.size());
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const bool isMiss = a[i].face == kNoFace;
    const bool isSameDistance = isMiss ? a[i].distance == b[i].distance
                                       : std::abs(a[i].distance - b[i].distance) <= 1e-4f * b[i].distance + kResolution;
    count += a[i].face != b[i].face || !isSameDistance;
  }
  return count;
}

/// Rays without a hit. Their distances, and no others, are infinite.
inline size_t missCount(const std::vector<ConeHit>& hits) {
  size_t count = 0;
  for (const ConeHit& hit : hits) {
    count += hit.face == kNoFace;
    CHECK((hit.face == kNoFace) == std::isinf(hit.distance));
  }
  return count;
}

}  // namespace asdfvk
