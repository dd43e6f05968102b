#include "bvh/sah.h"

#include <algorithm>
#include <array>
#include <limits>

namespace asdfvk {
namespace {

constexpr uint32_t kMaxBinCount = 32;
// Number of triangles in the sample. Every n-th triangle is in the sample. The best split of the sample is nearly as
// good as the best split of all triangles.
constexpr size_t kSampleCount = 1024;

// The bounding box and the number of the sampled triangles in each bin of each axis.
struct Bins {
  std::array<std::array<Float8, kMaxBinCount>, 3> boxes;
  std::array<std::array<uint32_t, kMaxBinCount>, 3> counts{};

  ASDFVK_ALWAYS_INLINE explicit Bins(uint32_t binCount) {
    for (auto& axisBoxes : boxes)
      for (uint32_t i = 0; i < binCount; ++i) axisBoxes[i] = broadcast<Float8>(std::numeric_limits<float>::infinity());
  }
  ASDFVK_ALWAYS_INLINE void add(const SplitTriangle& triangle, const IntsOf<Float4>& binIndices) {
    const auto box = load<Float8>(triangle.numbers());
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto bin = static_cast<uint32_t>(binIndices[axis]);
      boxes[axis][bin] = min(box, boxes[axis][bin]);
      ++counts[axis][bin];
    }
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE SplitBox box(size_t axis, uint32_t bin) const {
    const auto* numbers = reinterpret_cast<const float*>(&boxes[axis][bin]);
    return {load<Float4>(numbers), load<Float4>(numbers + 4)};
  }
};

// Maps doubled centres to bins, per axis. Factor 0 means that the axis cannot be split, because the centres coincide or
// are so close that the factor would overflow.
struct Binning {
  Float4 origin, factor;
  uint32_t binCount = 0;

  ASDFVK_ALWAYS_INLINE Binning(const SplitBox& centres, uint32_t count) : origin(centres.lower), binCount(count) {
    // Slightly less than the bin count: then rounding moves no centre beyond the last bin.
    const Float4 f = static_cast<float>(count) * (1 - 0x1p-20f) / centres.extents();
    const IntsOf<Float4> isFinite = f - f == 0;
    factor = select(isFinite, f);
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE IntsOf<Float4> binsOf(const SplitBox& box) const {
    return __builtin_convertvector((box.doubledCentre() - origin) * factor, IntsOf<Float4>);
  }
  // Position in units of bins; the integer part is the bin index. May be out of range for triangles outside the sample.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE float place(const SplitBox& box, size_t axis) const {
    return (box.doubledCentre(axis) - origin[axis]) * factor[axis];
  }
};

struct Candidate {
  float cost = std::numeric_limits<float>::infinity();  // Half area times triangle count.
  size_t axis = 0;
  uint32_t firstRightBin = 0;
};

ASDFVK_ALWAYS_INLINE inline void takeBest(const Bins& bins, uint32_t binCount, size_t axis, Candidate& best) {
  const auto& counts = bins.counts[axis];
  std::array<float, kMaxBinCount> rightCost;
  SplitBox right = SplitBox::empty();
  uint32_t rightCount = 0;
  for (uint32_t i = binCount - 1; i > 0; --i) {
    right.grow(bins.box(axis, i));
    rightCount += counts[i];
    rightCost[i] = rightCount == 0 ? -1 : right.halfArea() * static_cast<float>(rightCount);
  }
  SplitBox left = SplitBox::empty();
  uint32_t leftCount = 0;
  for (uint32_t i = 1; i < binCount; ++i) {
    left.grow(bins.box(axis, i - 1));
    leftCount += counts[i - 1];
    if (leftCount == 0 || rightCost[i] < 0) continue;
    const float cost = left.halfArea() * static_cast<float>(leftCount) + rightCost[i];
    if (cost < best.cost) best = {cost, axis, i};
  }
}

ASDFVK_ALWAYS_INLINE inline SplitBox boundCentres(std::span<const SplitTriangle> triangles, size_t stride) {
  SplitBox centres = SplitBox::empty();
  for (size_t i = 0; i < triangles.size(); i += stride) {
    const Float4 centre = triangles[i].box.doubledCentre();
    centres.grow({centre, -centre});
  }
  return centres;
}

// Branch-free: the condition is unpredictable. Moves triangles as vectors of 32 bytes, because the load in Bins::add()
// would wait for two preceding stores of 16 bytes.
template <typename IsLeft>
ASDFVK_ALWAYS_INLINE inline size_t partitionTriangles(std::span<SplitTriangle> triangles, const IsLeft& isLeft) {
  size_t leftCount = 0;
  for (SplitTriangle& next : triangles) {
    const bool goesLeft = isLeft(next.box);
    const Float8 triangle = load<Float8>(next.numbers());
    store(next.numbers(), load<Float8>(triangles[leftCount].numbers()));
    store(triangles[leftCount].numbers(), triangle);
    leftCount += goesLeft ? 1 : 0;
  }
  return leftCount;
}

ASDFVK_ALWAYS_INLINE inline size_t splitAtBestBin(std::span<SplitTriangle> triangles, uint32_t binCount) {
  const size_t stride = std::max<size_t>(1, triangles.size() / kSampleCount);
  // Fewer bins for few triangles, as in Wald 2007 and Embree.
  const auto adaptedCount = static_cast<uint32_t>(std::min<size_t>(binCount, 4 + triangles.size() / 4));
  const Binning binning(boundCentres(triangles, stride), std::clamp(adaptedCount, 2u, kMaxBinCount));
  Bins bins(binning.binCount);
  for (size_t i = 0; i < triangles.size(); i += stride) bins.add(triangles[i], binning.binsOf(triangles[i].box));
  Candidate best;
  for (size_t axis = 0; axis < 3; ++axis)
    if (binning.factor[axis] > 0) takeBest(bins, binning.binCount, axis, best);
  if (best.firstRightBin == 0) return 0;
  const auto bound = static_cast<float>(best.firstRightBin);
  return partitionTriangles(
      triangles, [&](const SplitBox& box) ASDFVK_ALWAYS_INLINE { return binning.place(box, best.axis) < bound; });
}

}  // namespace

size_t splitBySah(std::span<SplitTriangle> triangles, uint32_t binCount, InstructionSet instructionSet) {
  return dispatch<Float8>(instructionSet,
                          [&]<typename>() ASDFVK_ALWAYS_INLINE { return splitAtBestBin(triangles, binCount); });
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
