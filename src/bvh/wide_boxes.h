#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/box3.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Margin of the boxes of a wide hierarchy on a device, in normalised units: a ray enters each box that contains a
/// triangle that the ray hits. The margin covers three errors of float32. The triangle test has an error of a few units
/// of 2^-24 times coordinates up to 3.5. Decoding a box has an error of up to 6 units of 2^-24. The distance to a plane
/// (shaders/trace/ray_query.glsl) has three roundings; each of them shifts the plane by up to 3.5 units of 2^-24.
///
/// kMantissaBytes adds two roundings. All lengths are along the axis here, where the longest side of the mesh is 2. A
/// step of the bytes is a power of two, so that 256 steps are at most 4.1 long. The start minus 256 steps is at most
/// 2.1 + 4.1 = 6.2 away and has an error of up to 6.2 units. The product with 1 + byte / 256 is at most 8.2 and has an
/// error of up to 8.2 units. The sum of all errors is below 4 * 3.5 + 6 + 3 * 3.5 + 6.2 + 8.2 = 45 of the 64 units.
inline constexpr float kWideBoxMargin = 0x1p-18f;

/// A node with the boxes of `children` in `slots`, enlarged by kWideBoxMargin and rounded outwards. childBase,
/// triangleBase and childBits are not set.
[[nodiscard]] DeviceWideNode quantizeBoxes(std::span<const Box3f> children,
                                           const std::array<uint32_t, kWideChildCount>& slots);

}  // namespace asdfvk
