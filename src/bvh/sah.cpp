#include "bvh/sah.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

constexpr uint32_t kMaxBinCount = 32;
// Number of triangles in the sample. Every n-th triangle is in the sample. The best split of the sample is nearly as
// good as the best split of all triangles.
constexpr size_t kSampleCount = 1024;

struct Bin {
  SplitBox box;
  uint32_t count;
};

// Maps doubled centres to bins, per axis. Factor 0 means that the axis cannot be split, because the centres coincide or
// are so close that the factor would overflow.
struct Binning {
  Float4 origin, factor{};
  uint32_t binCount = 0;

  Binning(const SplitBox& centres, uint32_t count) : origin(centres.lower), binCount(count) {
    // Slightly less than the bin count: then rounding moves no centre beyond the last bin.
    const float width = static_cast<float>(count) * (1 - 0x1p-20f);
    const Float4 extents = centres.extents();
    for (size_t axis = 0; axis < 3; ++axis)
      if (const float f = width / extents[axis]; std::isfinite(f)) factor[axis] = f;
  }
  [[nodiscard]] IntsOf<Float4> binsOf(const SplitBox& box) const {
    return __builtin_convertvector((box.doubledCentre() - origin) * factor, IntsOf<Float4>);
  }
  // Position in units of bins; the integer part is the bin index. May be out of range for triangles outside the sample.
  [[nodiscard]] float place(const SplitBox& box, size_t axis) const {
    return (box.doubledCentre(axis) - origin[axis]) * factor[axis];
  }
};

struct Candidate {
  float cost = std::numeric_limits<float>::infinity();  // Half area times triangle count.
  size_t axis = 0;
  uint32_t firstRightBin = 0;
};

void takeBest(std::span<const Bin> bins, size_t axis, Candidate& best) {
  std::array<float, kMaxBinCount> rightCost;
  SplitBox right = SplitBox::empty();
  uint32_t rightCount = 0;
  for (size_t i = bins.size() - 1; i > 0; --i) {
    right.grow(bins[i].box);
    rightCount += bins[i].count;
    rightCost[i] = rightCount == 0 ? -1 : right.halfArea() * static_cast<float>(rightCount);
  }
  SplitBox left = SplitBox::empty();
  uint32_t leftCount = 0;
  for (size_t i = 1; i < bins.size(); ++i) {
    left.grow(bins[i - 1].box);
    leftCount += bins[i - 1].count;
    if (leftCount == 0 || rightCost[i] < 0) continue;
    const float cost = left.halfArea() * static_cast<float>(leftCount) + rightCost[i];
    if (cost < best.cost) best = {cost, axis, static_cast<uint32_t>(i)};
  }
}

SplitBox boundCentres(std::span<const SplitTriangle> triangles, size_t stride) {
  SplitBox centres = SplitBox::empty();
  for (size_t i = 0; i < triangles.size(); i += stride) {
    const Float4 centre = triangles[i].box.doubledCentre();
    centres.grow({centre, -centre});
  }
  return centres;
}

// Branch-free: the condition is unpredictable.
template <typename IsLeft>
size_t partitionTriangles(std::span<SplitTriangle> triangles, const IsLeft& isLeft) {
  size_t leftCount = 0;
  for (SplitTriangle& next : triangles) {
    const bool goesLeft = isLeft(next.box);
    const SplitTriangle triangle = next;
    next = triangles[leftCount];
    triangles[leftCount] = triangle;
    leftCount += goesLeft ? 1 : 0;
  }
  return leftCount;
}

}  // namespace

size_t splitBySah(std::span<SplitTriangle> triangles, uint32_t binCount) {
  const size_t stride = std::max<size_t>(1, triangles.size() / kSampleCount);
  // Fewer bins for few triangles, as in Wald 2007 and Embree.
  const auto adaptedCount = static_cast<uint32_t>(std::min<size_t>(binCount, 4 + triangles.size() / 4));
  const Binning binning(boundCentres(triangles, stride), std::clamp(adaptedCount, 2u, kMaxBinCount));
  std::array<std::array<Bin, kMaxBinCount>, 3> bins;
  for (auto& axisBins : bins) std::fill_n(axisBins.begin(), binning.binCount, Bin{SplitBox::empty(), 0});
  for (size_t i = 0; i < triangles.size(); i += stride) {
    const SplitBox& box = triangles[i].box;
    const IntsOf<Float4> binIndices = binning.binsOf(box);
    for (size_t axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][static_cast<uint32_t>(binIndices[axis])];
      bin.box.grow(box);
      ++bin.count;
    }
  }
  Candidate best;
  for (size_t axis = 0; axis < 3; ++axis)
    if (binning.factor[axis] > 0) takeBest({bins[axis].data(), binning.binCount}, axis, best);
  if (best.firstRightBin == 0) return 0;
  const auto bound = static_cast<float>(best.firstRightBin);
  return partitionTriangles(triangles, [&](const SplitBox& box) { return binning.place(box, best.axis) < bound; });
}

size_t splitAtMedian(std::span<SplitTriangle> triangles) {
  const Float4 extents = boundCentres(triangles, 1).extents();
  size_t axis = 0;
  for (size_t other = 1; other < 3; ++other)
    if (extents[other] > extents[axis]) axis = other;
  const size_t half = triangles.size() / 2;
  if (extents[axis] > 0) {
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
                     [axis](const SplitTriangle& a, const SplitTriangle& b) {
                       const float ca = a.box.doubledCentre(axis), cb = b.box.doubledCentre(axis);
                       return ca != cb ? ca < cb : a.face() < b.face();
                     });
  }
  return half;
}

}  // namespace asdfvk
