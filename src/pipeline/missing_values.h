#pragma once

#include <span>
#include <string>

#include "mesh/mesh.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// Why faces without a value are likely to have none, as the end of a sentence: components that are inverted, a surface
/// that is open; empty where neither holds for any of them. values: #F, of the triangles.
[[nodiscard]] std::string likelyCauseOfMissingValues(const TriangleMesh& mesh, const PreparedMesh& prepared,
                                                     std::span<const double> values);

}  // namespace asdfvk
