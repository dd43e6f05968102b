#pragma once

#include <span>
#include <string>
#include <vector>

#include "asdf_vk/session.h"
#include "mesh/mesh.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// Values of input faces from those of triangles: the mean over the triangles of a polygon that have a value, weighted
/// by area. values, areas: #F. Returns #I; NaN for a polygon without a valued triangle.
[[nodiscard]] std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::span<const double> values,
                                                     std::span<const double> areas);

/// 1 where any triangle of the input face is a seed. isSeed: #F. Returns #I.
[[nodiscard]] std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed);

/// Segments of input faces from those of triangles (#F): that with the largest area in the polygon, the lowest of equal
/// ones; kNoSegment for a polygon without a triangle. Returns #I. Labels that no input face has are removed, and the
/// others keep their order.
[[nodiscard]] std::vector<uint32_t> segmentsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> segments,
                                                         std::span<const double> areas);

/// Adds to the report: the range of the values, the number of missing values, warnings about values and solver. sdf:
/// #I. values: #F. keepsMissing: see Computation.
void describeValues(Report& report, const PreparedMesh& prepared, const std::vector<double>& sdf,
                    std::span<const double> values, bool keepsMissing);

}  // namespace asdfvk
