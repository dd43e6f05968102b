#pragma once

#include <cstdint>

#include "generate/brick_lattice.h"

namespace asdfvk {

/// The lattice of the spacing at which the surface crosses about `quadCount` edges: within 2 % of it where that can be
/// had, else the nearest of the spacings tried.
[[nodiscard]] BrickLattice latticeOfSize(const CapsuleUnion& field, uint64_t quadCount);

}  // namespace asdfvk
