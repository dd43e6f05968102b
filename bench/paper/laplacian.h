#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk::bench {

/// The ASDF paper, section 4, Figure 2: F(p) = | sum w_v SDF(p) - sum w_v SDF(v) | over the faces v that share an edge
/// with p, w_v = 1 / distance of the barycentres. values: #F, NaN for none; the result is NaN there and leaves
/// neighbours without a value out. Barycentres in the same place have no weight and are left out too.
[[nodiscard]] std::vector<double> absoluteLaplacian(const Mesh& mesh, std::span<const double> values);

/// Over its own percentile (nearest rank, share in 0..1), and at most 1: a single face would darken all others if it
/// were over the maximum. NaN stays.
[[nodiscard]] std::vector<double> overPercentile(std::vector<double> values, double share);

}  // namespace asdfvk::bench
