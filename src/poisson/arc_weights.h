#pragma once

#include <vector>

#include "asdf_vk/options.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// Where the weight of a Feature arc has fallen to a half. Across a sharper edge the shape diameter changes
/// more, and on organic shapes some five times more where it is concave.
inline constexpr double kConcaveScaleDegrees = 3;
inline constexpr double kConvexScaleDegrees = 8;

/// One weight per arc, in the order of graph.neighbours: positive, finite, and the same bits in both directions.
/// Distances below 1e-9 of the box's diagonal count as that, so that coincident barycentres keep the matrix finite.
/// Distance has the unit of 1 / length, the others have none.
[[nodiscard]] std::vector<double> arcWeights(ArcWeights kind, const DualGraph& graph, const FaceGeometry& geometry);

}  // namespace asdfvk
