#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"

/// Two functions of CGAL 5.5.1 on the caller's values per face: sdf_values_postprocessing() and
/// segmentation_from_sdf_values() (docs/segmentation.md). Neither function contains code of CGAL. To compute CGAL's
/// sdf_values(), call applyDefinition(Definition::Cgal, options) and Session::compute().
///
/// Values and labels are per input face (#I). Each triangle of a polygon takes the value of the polygon. The resulting
/// value of a polygon is the area-weighted mean over its triangles. The resulting label of a polygon is the label that
/// covers the largest part of its area. For a mesh of triangles, the results are bit-identical to the fields
/// "normalized" and "segment" of Session::compute().
///
/// Two faces are neighbours if they share an edge that no third face has, and traverse this edge in opposite
/// directions. An edge of more than two faces is first divided. Two of its faces keep a common edge if chains of
/// neighbours connect the two faces around both ends of the edge. CGAL's readers have the same effect, because they
/// split vertices. An edge between faces of opposite winding is a boundary. CGAL's readers differ: where possible, they
/// reverse faces of such meshes. Vertices are compared by index.
///
/// All functions throw Error{EmptyMesh}, Error{ArraySize} for arrays of a wrong size, Error{IndexOutOfRange},
/// Error{MeshTooLarge}, Error{ValueOutOfRange} and Error{Cancelled}. Results are bit-identical for any number of
/// threads.
namespace asdfvk {

struct PostprocessedSdf {
  std::vector<double> normalized;  ///< #I, 0 to 1; NaN for an input face without a triangle.
  double min = 0, max = 0;         ///< The smoothed values that are mapped to 0 and 1, in the unit of the input.
};

/// Fills missing values, smooths all values by a bilateral filter and maps them to [0, 1]. If all smoothed values are
/// equal, they are not mapped and keep the unit of the input. values: #I, finite and at least 0; NaN for no value.
/// Polls for a stop every 256 faces. Throws Error{NoValues} if no face has a value.
[[nodiscard]] ASDFVK_API PostprocessedSdf postprocessSdf(const MeshView& mesh, std::span<const double> values,
                                                         const RunControl& control = {});

enum class CgalLabels {
  Segments,  ///< Sets of connected faces of one cluster, numbered by ascending mean value.
  Clusters,  ///< Clusters of values, numbered by ascending mean, as with CGAL's output_cluster_ids.
};

struct LabelledFaces {
  std::vector<uint32_t> labels;  ///< #I, below `count`; kNoSegment for an input face without a triangle.
  uint32_t count = 0;            ///< Number of segments; for Clusters, CgalSegmentationOptions::clusterCount.
};

/// Clusters the values and divides the mesh by a graph cut. values: #I, 0 to 1, as postprocessSdf() returns them. A NaN
/// is a missing value and is filled as in postprocessSdf(). Values of input faces without a triangle are ignored. Polls
/// for a stop between the expansions of the graph cut. Throws Error{OptionOutOfRange}, Error{NoValues} if no face has a
/// value, and Error{TooFewValues} if there are fewer distinct values than clusters.
[[nodiscard]] ASDFVK_API LabelledFaces segmentSdf(const MeshView& mesh, std::span<const double> values,
                                                  const CgalSegmentationOptions& options = {},
                                                  CgalLabels labels = CgalLabels::Segments,
                                                  const RunControl& control = {});

}  // namespace asdfvk
