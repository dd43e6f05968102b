#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// For each component 1 if it is closed and inside an odd number of other closed components, else 0. #components.
/// Determined by the parity of the faces crossed by rays from inside of its outermost corners along each axis; a
/// component that is only partly inside another one counts as outside, as does one that touches its box. One that is
/// wound as a body and touches the box of a component that may contain it is no cavity. Time: about n log c for n faces
/// and c components; more where many components are nested, or many long faces cross many components.
[[nodiscard]] std::vector<uint8_t> findCavities(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
