#pragma once

#include <cstdint>
#include <span>

#include "bvh/split_box.h"

namespace asdfvk {

/// Splits by the binned surface-area heuristic (Wald 2007), over a sample of the triangles where they are many:
/// reorders `triangles` and returns how many went left, at least one and less than all. 0 without reordering where all
/// centres coincide, at least those of the sample. binCount: per axis, 2 to 32.
[[nodiscard]] size_t splitBySah(std::span<SplitTriangle> triangles, uint32_t binCount);

/// Splits at the median of the centres on their widest axis; in the middle of the order where all of them coincide.
/// Precondition: at least two triangles.
[[nodiscard]] size_t splitAtMedian(std::span<SplitTriangle> triangles);

}  // namespace asdfvk
