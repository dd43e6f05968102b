#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vec3.h"

namespace asdfvk {

/// An axis-aligned box; empty (min > max) until something is added. Coordinates may be any finite numbers of T. If a
/// size or a diagonal would overflow, the result is the largest number of T.
template <typename T>
struct Box3 {
  Vec3<T> min{std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity(),
              std::numeric_limits<T>::infinity()};
  Vec3<T> max{-std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
              -std::numeric_limits<T>::infinity()};

  void add(const Vec3<T>& p) {
    for (size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], p[axis]);
      max[axis] = std::max(max[axis], p[axis]);
    }
  }
  void add(const Box3& other) {
    for (size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], other.min[axis]);
      max[axis] = std::max(max[axis], other.max[axis]);
    }
  }
  [[nodiscard]] bool isEmpty() const { return !(min.x <= max.x); }
  [[nodiscard]] Vec3<T> size() const {
    if (isEmpty()) return {};
    const Vec3<T> s = max - min;
    return {saturated(s.x), saturated(s.y), saturated(s.z)};
  }
  [[nodiscard]] Vec3<T> halfSize() const { return isEmpty() ? Vec3<T>{} : max * T(0.5) - min * T(0.5); }
  [[nodiscard]] Vec3<T> centre() const { return isEmpty() ? Vec3<T>{} : min * T(0.5) + max * T(0.5); }
  [[nodiscard]] T diagonal() const {
    const Vec3<T> s = size();
    return saturated(lengthInAnyUnit(s));
  }
  /// Precondition: areas neither overflow nor underflow, as in normalised units.
  [[nodiscard]] T halfArea() const {
    const Vec3<T> s = size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
  }

 private:
  [[nodiscard]] static T saturated(T length) { return std::min(length, std::numeric_limits<T>::max()); }
};

using Box3d = Box3<double>;
using Box3f = Box3<float>;

/// Whether `inner` lies inside `outer` with a distance of more than `margin` between corresponding sides. With a
/// negative margin, `inner` may extend beyond `outer` by less than -margin.
[[nodiscard]] inline bool containsBy(double margin, const Box3d& outer, const Box3d& inner) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (!(inner.min[axis] - outer.min[axis] > margin && outer.max[axis] - inner.max[axis] > margin)) return false;
  return true;
}

/// Squared distance between a point and a box with the members `min` and `max`; 0 inside.
template <typename Box>
[[nodiscard]] double squaredDistanceToBox(const Box& box, const Vec3d& p) {
  double square = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({box.min[axis] - p[axis], p[axis] - box.max[axis], 0.0});
    square += gap * gap;
  }
  return square;
}

}  // namespace asdfvk
