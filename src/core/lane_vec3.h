#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "core/vec3.h"

/// Vectors in space, one per lane, for dispatch(). Results have the same bits as those of core/vec3.h.
namespace asdfvk {

struct Vec3Double4 {
  Double4 x, y, z;
};

using LaneIndices = std::array<uint32_t, kLaneCount<Double4>>;

ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator+(const Vec3Double4& a, const Vec3Double4& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator+(const Vec3d& a, const Vec3Double4& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator-(const Vec3Double4& a, const Vec3Double4& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator*(const Vec3Double4& a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator/(const Vec3Double4& a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator*(const Double4& s, const Vec3d& a) {
  return {s * a.x, s * a.y, s * a.z};
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 operator*(const Double4& s, const Vec3Double4& a) {
  return {s * a.x, s * a.y, s * a.z};
}
ASDFVK_ALWAYS_INLINE inline Double4 dot(const Vec3Double4& a, const Vec3d& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
ASDFVK_ALWAYS_INLINE inline Double4 dot(const Vec3Double4& a, const Vec3Double4& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
ASDFVK_ALWAYS_INLINE inline Vec3Double4 cross(const Vec3Double4& a, const Vec3Double4& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

ASDFVK_ALWAYS_INLINE inline Double4 squareRoots(const Double4& x) {
  Double4 roots;
  for (size_t lane = 0; lane < kLaneCount<Double4>; ++lane) roots[lane] = std::sqrt(x[lane]);
  return roots;
}

/// Lane i has vectors[indices[i]].
ASDFVK_ALWAYS_INLINE inline Vec3Double4 gather(const Vec3d* vectors, const LaneIndices& indices) {
  const auto &a = vectors[indices[0]], &b = vectors[indices[1]], &c = vectors[indices[2]], &d = vectors[indices[3]];
  return {Double4{a.x, b.x, c.x, d.x}, Double4{a.y, b.y, c.y, d.y}, Double4{a.z, b.z, c.z, d.z}};
}

/// Stores lane i in vectors[i].
ASDFVK_ALWAYS_INLINE inline void storeVectors(Vec3d* vectors, const Vec3Double4& v) {
  for (size_t lane = 0; lane < kLaneCount<Double4>; ++lane) vectors[lane] = {v.x[lane], v.y[lane], v.z[lane]};
}

}  // namespace asdfvk
