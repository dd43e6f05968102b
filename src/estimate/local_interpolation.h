#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// An interpolation on a dual graph (poisson/poisson_system.h) and its solution. Views only. Spans of values have an
/// entry per face.
struct SolvedInterpolation {
  const DualGraph& graph;
  std::span<const double> weights;      ///< One per arc.
  std::span<const double> constraints;  ///< NaN for a face without a constraint.
  std::span<const double> guide;        ///< A field whose divergenceOf() the equation includes. May be empty.
  std::span<const double> divergence;   ///< Further divergence; may be empty.
  std::span<const double> solution;     ///< The solution with all seeds; `constraints` has fewer seeds.
};

/// The values of the interpolation at `faces` if it has `constraints` only. The effect of a constraint decays within a
/// few cells of other constraints. The equation is therefore solved around each of the faces separately, up to the
/// nearest kLocalConstraintCount constraints. Farther away, values are taken from `solution`. Returns #faces, NaN where
/// no constraint and no solution is near. The result does not depend on the number of threads.
[[nodiscard]] std::vector<double> interpolateLocally(const SolvedInterpolation& solved,
                                                     std::span<const uint32_t> faces);

inline constexpr uint32_t kLocalConstraintCount = 5;

}  // namespace asdfvk
