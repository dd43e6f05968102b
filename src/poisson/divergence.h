#pragma once

#include <span>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// What guides an interpolation along the differences of a predicted field, see buildPoissonSystem(): #F, per face the
/// sum over its neighbours g of w_fg (field(f) - field(g)) where both are finite. weights: one per arc.
[[nodiscard]] std::vector<double> divergenceOf(const DualGraph& graph, std::span<const double> weights,
                                               std::span<const double> field);

}  // namespace asdfvk
