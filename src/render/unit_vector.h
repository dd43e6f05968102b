#pragma once

#include "core/vec3.h"

namespace asdfvk {

/// v scaled to length 1, or `fallback` if v has no direction.
[[nodiscard]] inline Vec3d unitVector(const Vec3d& v, const Vec3d& fallback) {
  const double norm = length(v);
  return norm > 1e-150 && std::isfinite(norm) ? v / norm : fallback;
}

}  // namespace asdfvk
