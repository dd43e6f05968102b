#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/session.h"
#include "mesh/mesh.h"
#include "pipeline/face_domain.h"

namespace asdfvk {

/// Values of input faces from those of triangles: the mean over the triangles of a polygon that have a value, weighted
/// by area. values, areas: #F. Returns #I; NaN for a polygon without a valued triangle.
[[nodiscard]] std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::span<const double> values,
                                                     std::span<const double> areas);

/// 1 where any triangle of the input face is a seed. isSeed: #F. Returns #I.
[[nodiscard]] std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed);

/// The label with the largest sum of areas, the lowest of equal ones; kNoSegment where there is none. Sorts the pairs
/// of a label and an area by label.
[[nodiscard]] uint32_t labelOfLargestArea(std::vector<std::pair<uint32_t, double>>& areas);

/// Labels of input faces from those of triangles (#F): that with the largest area in the polygon, the lowest of equal
/// ones; kNoSegment for a polygon without a triangle. Returns #I.
[[nodiscard]] std::vector<uint32_t> labelsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> labels,
                                                       std::span<const double> areas);

/// The same for segments: numbers that no input face has are removed, and the others keep their order.
[[nodiscard]] std::vector<uint32_t> segmentsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> segments,
                                                         std::span<const double> areas);

/// Of the numbers other than kNoSegment, which begin at 0.
[[nodiscard]] uint32_t countSegments(std::span<const uint32_t> segments);

/// Skeleton points of input faces: c - n sdf / 2, the middle of the shape below the face. c and n are the barycentre
/// and the normal of a triangle; of a polygon, the means over its triangles weighted by area, n scaled to length 1.
/// sdf: #I. Returns 3 #I: x, y, z; NaN where there is no value or no normal (all triangles of zero area).
[[nodiscard]] std::vector<double> centresOfInputFaces(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                                      std::span<const double> sdf);

/// Number of input faces of the domain without a value. field: #I.
[[nodiscard]] uint64_t countWithoutValue(const FaceDomain& domain, std::span<const double> field);

/// Adds to the report: the range of the values, the number of missing values of the domain, warnings about values and
/// solver. sdf: #I. values: #F. keepsMissing: see Computation.
void describeValues(Report& report, const PreparedMesh& prepared, const FaceDomain& domain,
                    const std::vector<double>& sdf, std::span<const double> values, bool keepsMissing);

}  // namespace asdfvk
