#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "shared/cone_hit.h"

namespace asdfvk {

// What float32 makes of coordinates near 1 when the ray is grazing: distances shorter than 1e-2 are off by it.
inline constexpr float kResolution = 0x1p-20f;

/// Rays that met another face, or the same at a distance that is not the same to 1e-4 of it or kResolution.
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

/// Rays that met nothing; each of them is infinitely long, and no other.
inline size_t missCount(const std::vector<ConeHit>& hits) {
  size_t count = 0;
  for (const ConeHit& hit : hits) {
    count += hit.face == kNoFace;
    CHECK((hit.face == kNoFace) == std::isinf(hit.distance));
  }
  return count;
}

}  // namespace asdfvk
