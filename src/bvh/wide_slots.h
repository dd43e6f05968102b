#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/box3.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Assigns a different slot s to each of at most eight children. A ray whose direction has the sign bits q hits the
/// children approximately in ascending order of s ^ q. Greedy (Ylitie et al. 2017, section 3.2, use an auction).
[[nodiscard]] std::array<uint32_t, kWideChildCount> chooseSlots(std::span<const Box3f> children);

}  // namespace asdfvk
