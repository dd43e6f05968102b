#pragma once

#include <vector>

#include "asdf_vk/options.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// Dihedral angles at which the weight Feature is 1/2. The shape diameter changes more across sharper edges, and on
/// organic shapes about five times more across concave edges than across convex ones.
inline constexpr double kConcaveScaleDegrees = 3;
inline constexpr double kConvexScaleDegrees = 8;

/// The larger the weight of an arc, the closer the interpolated values of its two faces.
///   Distance: 1 / distance of the barycentres (ASDF paper, section 4.1)
///   Feature:  1 / (1 + (a / s)^2), a: dihedral angle, s: kConcaveScaleDegrees or kConvexScaleDegrees
/// One weight per arc, in the order of graph.neighbours: positive, finite, and with the same bits in both directions.
/// Unit: 1 / length for Distance, none for Feature. Distances below 1e-9 of the diagonal of the bounding box are
/// replaced by that, which keeps the matrix finite for coincident barycentres.
[[nodiscard]] std::vector<double> arcWeights(ArcWeights kind, const DualGraph& graph, const FaceGeometry& geometry);

}  // namespace asdfvk
