#include "mesh/normalization.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {

Normalization normalizationOf(const Box3d& bounds) {
  const Vec3d halfSize = bounds.halfSize();
  const double halfExtent = std::max({halfSize.x, halfSize.y, halfSize.z});
  Normalization normalization{bounds.centre(), 1};
  if (!(halfExtent > 0) || !std::isfinite(halfExtent)) return normalization;
  int exponent = 0;
  std::frexp(halfExtent, &exponent);  // halfExtent = m * 2^exponent with m in [0.5, 1)
  normalization.scale = std::ldexp(1.0, std::clamp(-exponent, -1024, 1023));
  return normalization;
}

}  // namespace asdfvk
