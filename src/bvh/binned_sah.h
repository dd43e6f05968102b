#pragma once

#include <cstdint>
#include <span>

#include "bvh/split_box.h"

namespace asdfvk {

/// Costs of the surface-area heuristic, relative to each other: entering a node (two box tests) and one triangle test.
inline constexpr float kNodeCost = 1.0f;
inline constexpr float kTriangleCost = 1.0f;

/// The box of some triangles and the box of their boxes' doubled centres.
struct SplitBounds {
  SplitBox box = SplitBox::empty();
  SplitBox centres = SplitBox::empty();
};

[[nodiscard]] SplitBounds boundsOf(std::span<const SplitTriangle> triangles);

/// Splits by the binned surface-area heuristic: reorders `triangles` and returns how many went left, always at least
/// one and less than all. 0 without reordering where a leaf is allowed and cheaper, or where all centres coincide and
/// there is nothing to choose (told apart by the caller: a leaf needs `leafAllowed`).
[[nodiscard]] size_t splitBySah(std::span<SplitTriangle> triangles, const SplitBounds& bounds, uint32_t binCount,
                                bool leafAllowed);

/// Splits at the median of the centres on their widest axis; in the middle of the order where all of them coincide.
/// Precondition: at least two triangles.
[[nodiscard]] size_t splitAtMedian(std::span<SplitTriangle> triangles, const SplitBounds& bounds);

}  // namespace asdfvk
