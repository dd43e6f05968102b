#pragma once

#include <algorithm>
#include <limits>

#include "core/vec3.h"

namespace asdfvk {

/// An axis-aligned box; empty (min > max) until something is added.
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
  [[nodiscard]] Vec3<T> size() const { return isEmpty() ? Vec3<T>{} : max - min; }
  [[nodiscard]] Vec3<T> centre() const { return isEmpty() ? Vec3<T>{} : min + (max - min) * T(0.5); }
  [[nodiscard]] T diagonal() const { return length(size()); }
  [[nodiscard]] T halfArea() const {
    const Vec3<T> s = size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
  }
};

using Box3d = Box3<double>;
using Box3f = Box3<float>;

}  // namespace asdfvk
