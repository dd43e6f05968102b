#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// For each vertex the lowest vertex at exactly the same point; the vertex itself where there is no other. #V. -0
/// equals 0. A vertex with a non-finite coordinate equals only itself.
[[nodiscard]] std::vector<uint32_t> coincidentVertices(const TriangleMesh& mesh);

}  // namespace asdfvk
