#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/box3.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Boxes of a wide hierarchy grow by this on a device, in normalised units. Beyond what kDeviceBoxMargin is for: a
/// device decodes them in float32, which is off by up to 6 units of 2^-24, and finds the distance to a plane with three
/// more roundings, each of which is as if the plane had moved by 2^-24 of a distance up to 3.5
/// (shaders/wide_walk.glsl).
inline constexpr float kWideBoxMargin = 0x1p-18f;

/// The slot of each of at most eight children, each another one: the children that a ray meets first should have small
/// numbers s ^ q for rays whose direction has the sign bits q. Greedy (Ylitie et al. 2017, section 3.2, use an
/// auction).
[[nodiscard]] std::array<uint32_t, kWideChildCount> chooseSlots(std::span<const Box3f> children);

/// A frame on `children` (in slots `slots`), and their boxes in it, grown outwards; no references yet.
[[nodiscard]] DeviceWideNode quantizeBoxes(std::span<const Box3f> children,
                                           const std::array<uint32_t, kWideChildCount>& slots);

}  // namespace asdfvk
