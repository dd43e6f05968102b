#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"

/// CGAL's functions on values per face that the caller has: sdf_values_postprocessing() and
/// segmentation_from_sdf_values() of version 5.5.1 (docs/segmentation.md). They contain no code of CGAL. CGAL's
/// sdf_values() is Session::compute() with applyDefinition(Definition::Cgal).
///
/// Values and labels are per input face (#I). The triangles of a polygon have the value of the polygon; the value of a
/// polygon is the mean over its triangles, weighted by area, and its label the one with the largest area. For a mesh of
/// triangles the results have the bits of the fields "normalized" and "segment" of Session::compute().
///
/// Neighbours are the faces across an edge of exactly two faces that traverse it in opposite directions. An edge of
/// more faces is first divided as CGAL's readers do by splitting vertices: its faces stay together where neighbours
/// connect them around both ends. An edge between faces of opposite winding is a border; CGAL's readers reverse faces
/// of such meshes where they can. Vertices are compared by index.
///
/// All functions throw Error{EmptyMesh}, Error{ArraySize} for arrays of a wrong size, Error{IndexOutOfRange},
/// Error{MeshTooLarge}, Error{ValueOutOfRange}, Error{Cancelled}. The result has the same bits on any number of
/// threads.
namespace asdfvk {

struct PostprocessedSdf {
  std::vector<double> normalized;  ///< #I, 0 to 1; NaN for an input face without a triangle.
  double min = 0, max = 0;         ///< Range of the smoothed values, which 0 and 1 stand for, in the unit of the input.
};

/// Fills missing values, smooths all by a bilateral filter and maps them to [0, 1]. Where all smoothed values are
/// equal, they stay as they are, in the unit of the input. values: #I, at least 0 and finite, or NaN for no value. A
/// stop is polled every 256 faces. Throws Error{NoValues} where no face has a value.
[[nodiscard]] ASDFVK_API PostprocessedSdf postprocessSdf(const MeshView& mesh, std::span<const double> values,
                                                         const RunControl& control = {});

enum class CgalLabels {
  Segments,  ///< Connected faces of one cluster, numbered by ascending mean value.
  Clusters,  ///< Clusters of values, numbered by ascending mean: CGAL's output_cluster_ids.
};

struct LabelledFaces {
  std::vector<uint32_t> labels;  ///< #I, below `count`; kNoSegment for an input face without a triangle.
  uint32_t count = 0;            ///< Number of segments; CgalSegmentationOptions::clusterCount for clusters.
};

/// Clusters the values and divides the mesh by a graph cut. values: #I, 0 to 1, as postprocessSdf() returns them, or
/// NaN for no value, which is filled as postprocessSdf() does; ignored at input faces without a triangle. Polled
/// between the expansions of the graph cut. Throws Error{OptionOutOfRange}, Error{NoValues} where no face has a value,
/// and Error{TooFewValues} where there are fewer different values than clusters.
[[nodiscard]] ASDFVK_API LabelledFaces segmentSdf(const MeshView& mesh, std::span<const double> values,
                                                  const CgalSegmentationOptions& options = {},
                                                  CgalLabels labels = CgalLabels::Segments,
                                                  const RunControl& control = {});

}  // namespace asdfvk
