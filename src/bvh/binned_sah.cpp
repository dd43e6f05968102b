#include "bvh/binned_sah.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

constexpr uint32_t kMaxBinCount = 32;

struct Bin {
  SplitBox box = SplitBox::empty();
  uint32_t count = 0;
};

// Maps doubled centres to bins, per axis; an axis on which the centres coincide (or nearly, so that a float's range
// does not hold the factor) has factor 0 and cannot be split.
struct Binning {
  std::array<float, 3> origin{}, factor{};
  uint32_t binCount = 0;

  Binning(const SplitBox& centres, uint32_t count) : binCount(count) {
    for (size_t axis = 0; axis < 3; ++axis) {
      origin[axis] = centres.min(axis);
      const float f = static_cast<float>(count) / centres.extent(axis);
      factor[axis] = std::isfinite(f) ? f : 0;
    }
  }
  [[nodiscard]] uint32_t binOf(const SplitBox& box, size_t axis) const {
    const auto bin = static_cast<int32_t>((box.doubledCentre(axis) - origin[axis]) * factor[axis]);
    return std::min(static_cast<uint32_t>(bin), binCount - 1);
  }
};

struct Candidate {
  float cost = std::numeric_limits<float>::infinity();  // Area times triangles, not yet over the parent's area.
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

}  // namespace

SplitBounds boundsOf(std::span<const SplitTriangle> triangles) {
  SplitBounds bounds;
  for (const SplitTriangle& triangle : triangles) {
    SplitBox centre;
    for (size_t i = 0; i < 4; ++i) {
      const float c = triangle.box.lanes[i] - triangle.box.lanes[i + 4];
      centre.lanes[i] = c;
      centre.lanes[i + 4] = -c;
    }
    bounds.box.grow(triangle.box);
    bounds.centres.grow(centre);
  }
  return bounds;
}

size_t splitBySah(std::span<SplitTriangle> triangles, const SplitBounds& bounds, uint32_t binCount, bool leafAllowed) {
  // Few triangles do not pay for many bins (Wald 2007 and Embree do likewise).
  const auto adaptedCount = static_cast<uint32_t>(std::min<size_t>(binCount, 4 + triangles.size() / 4));
  const Binning binning(bounds.centres, std::clamp(adaptedCount, 2u, kMaxBinCount));
  std::array<std::array<Bin, kMaxBinCount>, 3> bins;
  for (const SplitTriangle& triangle : triangles) {
    for (size_t axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][binning.binOf(triangle.box, axis)];
      bin.box.grow(triangle.box);
      ++bin.count;
    }
  }
  Candidate best;
  for (size_t axis = 0; axis < 3; ++axis)
    if (binning.factor[axis] > 0) takeBest({bins[axis].data(), binning.binCount}, axis, best);
  if (best.firstRightBin == 0) return 0;

  const float area = bounds.box.halfArea();
  if (leafAllowed &&
      kTriangleCost * static_cast<float>(triangles.size()) * area <= kNodeCost * area + kTriangleCost * best.cost)
    return 0;
  const auto middle = std::partition(triangles.begin(), triangles.end(), [&](const SplitTriangle& triangle) {
    return binning.binOf(triangle.box, best.axis) < best.firstRightBin;
  });
  return static_cast<size_t>(middle - triangles.begin());
}

size_t splitAtMedian(std::span<SplitTriangle> triangles, const SplitBounds& bounds) {
  size_t axis = 0;
  for (size_t other = 1; other < 3; ++other)
    if (bounds.centres.extent(other) > bounds.centres.extent(axis)) axis = other;
  const size_t half = triangles.size() / 2;
  if (bounds.centres.extent(axis) > 0) {
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
                     [axis](const SplitTriangle& a, const SplitTriangle& b) {
                       const float ca = a.box.doubledCentre(axis), cb = b.box.doubledCentre(axis);
                       return ca != cb ? ca < cb : a.face < b.face;
                     });
  }
  return half;
}

}  // namespace asdfvk
