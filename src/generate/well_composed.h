#pragma once

#include <cstdint>

namespace asdfvk {

/// The eight points around a lattice cell, as a mask of those inside (bit i + 2 j + 4 k: corner (i, j, k)).
/// Well-composed: no two inside and no two outside points touch only across a diagonal of a side or of the cell.
/// Returns -1 for a well-composed mask. Otherwise returns an outside corner; the addition of this corner to the mask
/// makes it well-composed, or brings it one step closer.
[[nodiscard]] int32_t cornerToFill(uint32_t mask);

}  // namespace asdfvk
