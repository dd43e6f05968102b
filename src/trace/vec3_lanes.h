#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/simd.h"
#include "core/vec3.h"

namespace asdfvk {

/// A vector for each lane.
template <typename Floats>
struct Vec3Lanes {
  Floats x, y, z;
};

template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Vec3Lanes<Floats> inAllLanes(const Vec3f& v) {
  return {broadcast<Floats>(v.x), broadcast<Floats>(v.y), broadcast<Floats>(v.z)};
}

template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Floats dotLanes(const Vec3f& a, const Vec3Lanes<Floats>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Floats dotLanes(const Vec3Lanes<Floats>& a, const Vec3Lanes<Floats>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// `a` in the lanes of the mask, `b` in the others.
template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Vec3Lanes<Floats> either(const IntsOf<Floats>& mask,
                                                                   const Vec3Lanes<Floats>& a,
                                                                   const Vec3Lanes<Floats>& b) {
  return {select(mask, a.x) + select(~mask, b.x), select(mask, a.y) + select(~mask, b.y),
          select(mask, a.z) + select(~mask, b.z)};
}

/// Squared distance between a box and the boxes [low, high] of the lanes.
template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Floats squaredDistance(const Vec3f& boxMin, const Vec3f& boxMax,
                                                                 const Vec3Lanes<Floats>& low,
                                                                 const Vec3Lanes<Floats>& high) {
  const auto gap = [&](float min, float max, const Floats& lowest, const Floats& highest)
                       ASDFVK_ALWAYS_INLINE { return asdfvk::max(asdfvk::max(min - highest, lowest - max), Floats{}); };
  const Floats x = gap(boxMin.x, boxMax.x, low.x, high.x), y = gap(boxMin.y, boxMax.y, low.y, high.y),
               z = gap(boxMin.z, boxMax.z, low.z, high.z);
  return x * x + y * y + z * z;
}

/// The points of a triangle nearest to the points `p` of the lanes, except for rounding. They are on the triangle, even
/// if it is very narrow: inside, they are means of the corners. normal: unit normal. spokes: the corners relative to
/// the middle.
template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Vec3Lanes<Floats> nearlyNearestPoint(const Vec3f& normal, const Vec3f& middle,
                                                                               const std::array<Vec3f, 3>& spokes,
                                                                               const Vec3Lanes<Floats>& p) {
  using Lanes = Vec3Lanes<Floats>;
  constexpr float kLeast = std::numeric_limits<float>::min(), kGreatest = std::numeric_limits<float>::max();
  Lanes nearest = p, weighted{};
  Floats least = broadcast<Floats>(kGreatest), total = broadcast<Floats>(kLeast);
  IntsOf<Floats> isInside = ~IntsOf<Floats>{};
  for (size_t k = 0; k < 3; ++k) {
    const Vec3f a = middle + spokes[k], edge = spokes[(k + 1) % 3] - spokes[k], inward = cross(normal, edge);
    const Vec3f& opposite = spokes[(k + 2) % 3];
    const Lanes d{p.x - a.x, p.y - a.y, p.z - a.z};
    const Floats weight = dotLanes(inward, d), positive = asdfvk::max(weight, Floats{});
    isInside &= lessEqual(Floats{}, weight);
    weighted = {weighted.x + positive * opposite.x, weighted.y + positive * opposite.y,
                weighted.z + positive * opposite.z};
    total += positive;
    const float square = std::max(dot(edge, edge), kLeast);
    const Floats t = asdfvk::min(asdfvk::max(dotLanes(edge, d) / square, Floats{}), broadcast<Floats>(1));
    const Lanes q{a.x + t * edge.x, a.y + t * edge.y, a.z + t * edge.z};
    const Lanes away{p.x - q.x, p.y - q.y, p.z - q.z};
    const Floats distance = dotLanes(away, away);
    nearest = either(lessEqual(distance, least), q, nearest);
    least = asdfvk::min(least, distance);
  }
  const Floats share = 1 / total;
  const Lanes mean{middle.x + weighted.x * share, middle.y + weighted.y * share, middle.z + weighted.z * share};
  return either(isInside, mean, nearest);
}

}  // namespace asdfvk
