#pragma once

#include <cstdint>
#include <span>

#include "bvh/split_box.h"

namespace asdfvk {

/// The box of some triangles and the box of their boxes' doubled centres.
struct SplitBounds {
  SplitBox box = SplitBox::empty();
  SplitBox centres = SplitBox::empty();

  void grow(const SplitBox& triangle) {
    const Quad centre = triangle.doubledCentre();
    box.grow(triangle);
    centres.grow({centre, -centre});
  }
  void grow(const SplitBounds& other) {
    box.grow(other.box);
    centres.grow(other.centres);
  }
};

/// Triangles in two parts: the first `leftCount` and the others.
struct Split {
  size_t leftCount = 0;
  SplitBounds left, right;
};

/// Splits by the binned surface-area heuristic (Wald 2007), over a sample of the triangles where they are many:
/// reorders `triangles`. Nothing goes left, and nothing is reordered, where all centres coincide; else neither part is
/// empty. binCount: per axis, 2 to 32.
[[nodiscard]] Split splitBySah(std::span<SplitTriangle> triangles, const SplitBounds& bounds, uint32_t binCount);

/// Splits at the median of the centres on their widest axis; in the middle of the order where all of them coincide.
/// Precondition: at least two triangles.
[[nodiscard]] Split splitAtMedian(std::span<SplitTriangle> triangles, const SplitBounds& bounds);

}  // namespace asdfvk
