#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "asdf_vk/session.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Values of input faces from values of triangles: the mean over the triangles of a polygon that have a value, weighted
/// by area. values, areas: #F. Returns #I; NaN for a polygon without a valued triangle. Returns the argument `values`
/// itself if every input face is a triangle.
[[nodiscard]] std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::vector<double> values,
                                                     std::span<const double> areas);

/// 1 where any triangle of the input face is a seed. isSeed: #F. Returns #I.
[[nodiscard]] std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed);

/// The label with the largest sum of areas; of equal sums, the lowest label. kNoSegment if `areas` is empty. Sorts the
/// pairs of a label and an area by label.
[[nodiscard]] uint32_t labelOfLargestArea(std::vector<std::pair<uint32_t, double>>& areas);

/// Labels of input faces from labels of triangles: the label with the largest area in the polygon; of equal areas, the
/// lowest label. kNoSegment for a polygon without a triangle. labels, areas: #F. Returns #I.
[[nodiscard]] std::vector<uint32_t> labelsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> labels,
                                                       std::span<const double> areas);

/// labelsOfInputFaces() of segments: numbers that no input face has are removed, and the others keep their order.
[[nodiscard]] std::vector<uint32_t> segmentsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> segments,
                                                         std::span<const double> areas);

/// The number of segments. Segments are numbered from 0; kNoSegment is not a segment.
[[nodiscard]] uint32_t countSegments(std::span<const uint32_t> segments);

}  // namespace asdfvk
