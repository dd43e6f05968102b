#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "mesh/face_geometry.h"
#include "segment/alpha_expansion.h"
#include "segment/face_neighbours.h"

/// The segmentation of CGAL's segmentation_from_sdf_values(): soft clustering of the values, then a graph cut that
/// prefers concave edges. Derived from the manual and the outputs of version 5.5.1, without code of CGAL. Source of the
/// method: L. Shapira, A. Shamir, D. Cohen-Or: Consistent Mesh Partitioning and Skeletonisation using the Shape
/// Diameter Function, 2008.
namespace asdfvk {

struct CgalSegmentation {
  std::vector<uint32_t> clusters;  ///< #F, ascending by their mean value.
  std::vector<uint32_t> segments;  ///< #F. Connected faces of one cluster are a segment. Ascending by mean value.
  uint32_t segmentCount = 0;
  double energy = 0;  ///< Energy of the clusters, see LabelProblem.
};

/// values: #F, finite, not negative, normalised by postprocessLikeCgal(). For the same values on a manifold mesh, CGAL
/// gives the same labels. The result does not depend on the number of threads. One cluster is also accepted; a negative
/// smoothness counts as 0. The clustering is not stable: noise of 1e-3 of the range may change many labels. Throws
/// Error{NoValues} without faces, Error{TooFewValues} if there are fewer different values than clusters, and
/// Error{Cancelled}.
[[nodiscard]] CgalSegmentation segmentLikeCgal(const FaceGeometry& geometry, const TriangleMesh& mesh,
                                               const FaceNeighbours& neighbours, std::span<const double> values,
                                               const CgalSegmentationOptions& options, const RunControl& control = {});

/// Returns an entry per common edge of two neighbouring faces f < g, ascending by f. The cost is
///   100 max(0, smoothness) * -log(max(5e-6, s angle / pi)),
/// with the angle between the normals in radians, and s = 0.08 on a convex edge and 1 elsewhere. Two special cases are
/// as in CGAL. If g has zero area, s angle / pi is 0 if all components of the normal of f are positive, else 0.08. If f
/// has zero area, s angle / pi is 0 if all components of the normal of g are negative, else 0.08.
[[nodiscard]] std::vector<LabelEdge> cgalEdgeCosts(const FaceGeometry& geometry, const TriangleMesh& mesh,
                                                   const FaceNeighbours& neighbours, double smoothness);

/// Components of neighbouring faces with the same label, numbered by ascending mean value. Components with equal means
/// are in the order of their first faces.
struct LabelComponents {
  std::vector<uint32_t> componentOf;  ///< #F
  uint32_t componentCount = 0;
};
[[nodiscard]] LabelComponents findLabelComponents(const FaceNeighbours& neighbours, std::span<const uint32_t> labels,
                                                  std::span<const double> values);

}  // namespace asdfvk
