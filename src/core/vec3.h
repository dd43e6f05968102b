#pragma once

#include <algorithm>
#include <cmath>

#include "asdf_vk/mesh.h"

namespace asdfvk {

struct LineSegment {
  Vec3d from, to;
};

template <typename T>
constexpr Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename T>
constexpr Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename T>
constexpr Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <typename T>
constexpr Vec3<T> operator*(const Vec3<T>& a, T s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <typename T>
constexpr Vec3<T> operator*(T s, const Vec3<T>& a) {
  return a * s;
}
template <typename T>
constexpr Vec3<T> operator/(const Vec3<T>& a, T s) {
  return {a.x / s, a.y / s, a.z / s};
}
template <typename T>
constexpr Vec3<T>& operator+=(Vec3<T>& a, const Vec3<T>& b) {
  return a = a + b;
}
template <typename T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}
/// The length of a, also if squares overflow or underflow. Not std::hypot(), whose bits differ between libraries.
template <typename T>
T lengthInAnyUnit(const Vec3<T>& a) {
  const T largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  return largest > 0 && std::isfinite(largest) ? largest * length(a / largest) : largest;
}
template <typename T>
bool isFinite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// v scaled to length 1. Precondition: v is finite and not 0. Squares neither overflow nor underflow.
[[nodiscard]] inline Vec3d unitVector(const Vec3d& v) {
  const Vec3d scaled = v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return scaled / length(scaled);
}
/// v scaled to length 1 in fewer operations. Returns `fallback` if the length is at most 1e-150 or not finite.
[[nodiscard]] inline Vec3d unitVector(const Vec3d& v, const Vec3d& fallback) {
  const double norm = length(v);
  return norm > 1e-150 && std::isfinite(norm) ? v / norm : fallback;
}

}  // namespace asdfvk
