#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Triangles back to the faces of the input: the mean over a polygon's triangles that have a value, weighted by area.
/// values, areas: #F. Returns #I; NaN for a polygon none of whose triangles has a value.
[[nodiscard]] std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::span<const double> values,
                                                     std::span<const double> areas);

/// 1 where any triangle of the input face is a seed. isSeed: #F. Returns #I.
[[nodiscard]] std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed);

}  // namespace asdfvk
