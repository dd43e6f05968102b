#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// For each component 1 when it is closed and lies inside an odd number of other closed components, else 0.
/// #components. Told by the parity of the faces that rays from its outermost vertices along each axis cross: one that
/// sticks out of another is not inside it. For n faces and c components about n log c; more only where many components
/// lie in each other, or many long faces cross many components.
[[nodiscard]] std::vector<uint8_t> findCavities(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
