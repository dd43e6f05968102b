#pragma once

#include <cstdint>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// How far a face is from its neighbour on the surface. No unit: about 1 for two neighbours of a smooth mesh.
enum class SurfaceMetric {
  Hops,    ///< 1 per mesh edge crossed.
  Length,  ///< Distance of the barycentres over the median of such distances.
  Angle,   ///< Hops stretched where the surface bends: sqrt(1 + (a / s)^2) for the dihedral angle a.
};

/// The angle s at which a step of SurfaceMetric::Angle is sqrt(2) hops. Concave edges separate parts of a shape, and
/// the shape diameter function changes across them sooner.
inline constexpr double kConcaveAngleDegrees = 10;
inline constexpr double kConvexAngleDegrees = 20;

/// No arc is shorter than kShortestArc or longer than kLongestArc, whatever the mesh; distances are float.
inline constexpr float kShortestArc = 0x1p-20f;
inline constexpr float kLongestArc = 0x1p+20f;

/// The length of each arc of the graph, aligned with graph.neighbours; the same in both directions.
/// Angles are those of signedDihedralAngle(): a degenerate face counts as lying in the plane of its neighbour, and
/// faces wound against each other are as far apart as their normals say.
[[nodiscard]] std::vector<float> arcLengths(const DualGraph& graph, const FaceGeometry& geometry, SurfaceMetric metric);

}  // namespace asdfvk
