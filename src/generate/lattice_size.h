#pragma once

#include <cstdint>

#include "generate/brick_lattice.h"

namespace asdfvk {

/// The lattice with the spacing at which the surface crosses about `quadCount` edges: within 2 % where possible, else
/// the closest of the tested spacings.
[[nodiscard]] BrickLattice latticeOfSize(const CapsuleUnion& field, uint64_t quadCount);

}  // namespace asdfvk
