#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// For each vertex the vertex that replaces it, #V. Each given vertex is replaced by a given vertex within `distance`
/// (normalised) of it that is not replaced itself, if there is one. Vertices at exactly the same point are replaced by
/// the lowest of them. vertices: ascending, with finite coordinates.
[[nodiscard]] std::vector<uint32_t> weldVertices(const TriangleMesh& mesh, const Normalization& unit,
                                                 std::span<const uint32_t> vertices, double distance);

}  // namespace asdfvk
