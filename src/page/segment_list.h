#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// A row of the list of segments.
struct PageSegment {
  uint32_t label = 0;
  uint64_t faceCount = 0;  ///< Number of triangles.
  double area = 0;
  double median = kNoValue;  ///< Median of the values of the triangles; NaN without values.
  Vec3d centre;              ///< Area-weighted mean of the barycentres.
};

/// Returns the segments, ascending by label. areas, barycentres: #F. labels, values: #I. Leaves out kNoSegment.
[[nodiscard]] std::vector<PageSegment> listSegments(const TriangleMesh& mesh, std::span<const double> areas,
                                                    std::span<const Vec3d> barycentres,
                                                    std::span<const uint32_t> labels, std::span<const double> values);

}  // namespace asdfvk
