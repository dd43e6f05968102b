#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk::bench {

/// The function of Figure 2 of the ASDF paper (section 4): F(p) = | sum w_v SDF(p) - sum w_v SDF(v) |. The sums are
/// over the faces v that share an edge with p; w_v = 1 / distance of the barycentres. values: #F, NaN for a face
/// without a value. The result is NaN for a face p without a value. Neighbours without a value, or with the same
/// barycentre, are skipped.
[[nodiscard]] std::vector<double> absoluteLaplacian(const Mesh& mesh, std::span<const double> values);

/// The percentile of the values that are not NaN, by the nearest rank. NaN if all values are NaN. share: 0 to 1.
[[nodiscard]] double percentileOf(std::vector<double> values, double share);

}  // namespace asdfvk::bench
