#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// For each vertex the lowest vertex at the very same point; itself where there is no other. #V. -0 equals 0; a vertex
/// with a number that is not finite equals only itself.
[[nodiscard]] std::vector<uint32_t> coincidentVertices(const TriangleMesh& mesh);

}  // namespace asdfvk
