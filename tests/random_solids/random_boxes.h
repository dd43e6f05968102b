#pragma once

#include <cstdint>

#include "generate/thickness_parts.h"

namespace asdfvk {

/// An open box of random size, with drafted walls (1 to 3 degrees) and a floor that are at least `limit` thick.
[[nodiscard]] ThicknessPart makeSoundBox(uint64_t seed, double limit);
/// A box of that kind with one pocket or groove, in a wall or in the floor, that leaves 20 % to 98 % of `limit`.
[[nodiscard]] ThicknessPart makeBoxWithThinPlace(uint64_t seed, double limit);

}  // namespace asdfvk
