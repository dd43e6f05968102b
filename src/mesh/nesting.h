#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// For each component the number of other closed components that it lies inside of; 0 for those that are not closed.
/// #components. One lies inside another when its outermost vertices along each axis all do, by the parity of the faces
/// that rays from them cross. For n faces and c components about n log c, worse only where many long faces cross many
/// components.
[[nodiscard]] std::vector<uint32_t> nestingDepths(const Mesh& mesh, const Components& components);

}  // namespace asdfvk
