#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/prepared_mesh.h"
#include "segment/parts.h"

namespace asdfvk {

struct SegmentBoundaries {
  std::vector<PartBoundary> list;  ///< Ascending by the segments.
  /// #I: the least stability of the boundaries at the face; NaN for a face that is at no boundary.
  std::vector<double> stability;
};

/// The boundaries of parts between input faces. segments: #I, from the parts by segmentsOfInputFaces().
[[nodiscard]] SegmentBoundaries boundariesOfInputFaces(const PreparedMesh& prepared, const Parts& parts,
                                                       std::span<const uint32_t> segments);

}  // namespace asdfvk
