#pragma once

#include <cstdint>

#include "core/vec3.h"

namespace asdfvk {

/// Bins of directions: a grid of kBinsPerSide^2 on each side of a cube. Along the middle lines of a side, each bin is
/// 10 degrees wide. Each axis is in the middle of a bin, so that rounding does not distribute an axis-aligned wall over
/// several bins.
inline constexpr uint32_t kBinsPerSide = 9;
inline constexpr uint32_t kNormalBinCount = 6 * kBinsPerSide * kBinsPerSide;
/// normal: unit. Returns less than kNormalBinCount.
[[nodiscard]] uint32_t normalBinOf(const Vec3d& normal);

}  // namespace asdfvk
