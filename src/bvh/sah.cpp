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

// For each axis, the bounding box and the number of the sampled triangles in the bin. The size is a power of two, so
// that the compiler finds the address of a bin by a shift instead of a multiplication.
struct alignas(128) Bin {
  std::array<Float8, 3> boxes;
  std::array<int32_t, 4> counts;  // Number 3 is 0.
};

class Bins {
 public:
  ASDFVK_ALWAYS_INLINE explicit Bins(uint32_t binCount) {
    for (uint32_t i = 0; i < binCount; ++i) {
      for (Float8& box : bins_[i].boxes) box = broadcast<Float8>(std::numeric_limits<float>::infinity());
      bins_[i].counts = {};
    }
  }
  ASDFVK_ALWAYS_INLINE void add(const SplitTriangle& triangle, const IntsOf<Float4>& binIndices) {
    const auto box = load<Float8>(triangle.numbers());
    for (size_t axis = 0; axis < 3; ++axis) {
      Bin& bin = bins_[static_cast<uint32_t>(binIndices[axis])];
      bin.boxes[axis] = min(box, bin.boxes[axis]);
      ++bin.counts[axis];
    }
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE const Bin& operator[](uint32_t bin) const { return bins_[bin]; }

 private:
  std::array<Bin, kMaxBinCount> bins_;
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

// One side of a split along each axis. Lane i of a vector of counts or costs has axis i; lane 3 has none.
struct Sides {
  std::array<SplitBox, 3> boxes{SplitBox::empty(), SplitBox::empty(), SplitBox::empty()};
  IntsOf<Float4> counts{};

  ASDFVK_ALWAYS_INLINE void add(const Bin& bin) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto* numbers = reinterpret_cast<const float*>(&bin.boxes[axis]);
      boxes[axis].grow({load<Float4>(numbers), load<Float4>(numbers + 4)});
    }
    counts += load<IntsOf<Float4>>(bin.counts.data());
  }
  // Half the area of the box, times the number of triangles. NaN without triangles, because an empty box has an
  // infinite area. NaN is not less than any cost, so that a split with an empty side is not chosen.
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Float4 costs() const {
    const Float4 a = boxes[0].extents(), b = boxes[1].extents(), c = boxes[2].extents();
    const Float4 low = __builtin_shufflevector(a, b, 0, 4, 1, 5), high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Float4 x = __builtin_shufflevector(low, c, 0, 1, 4, 4), y = __builtin_shufflevector(low, c, 2, 3, 5, 5),
                 z = __builtin_shufflevector(high, c, 0, 1, 6, 6);
    return (x * y + y * z + z * x) * __builtin_convertvector(counts, Float4);
  }
};

struct Candidate {
  size_t axis = 0;
  uint32_t firstRightBin = 0;  // 0 if there is no split.
};

ASDFVK_ALWAYS_INLINE inline Candidate bestSplit(const Bins& bins, const Binning& binning) {
  std::array<Float4, kMaxBinCount> rightCosts;
  Sides right;
  for (uint32_t i = binning.binCount - 1; i > 0; --i) {
    right.add(bins[i]);
    rightCosts[i] = right.costs();
  }
  Sides left;
  auto leastCosts = broadcast<Float4>(std::numeric_limits<float>::infinity());
  IntsOf<Float4> firstRightBins{};
  for (uint32_t i = 1; i < binning.binCount; ++i) {
    left.add(bins[i - 1]);
    const Float4 costs = left.costs() + rightCosts[i];
    const IntsOf<Float4> isLess = costs < leastCosts;
    leastCosts = isLess ? costs : leastCosts;
    firstRightBins = isLess ? broadcast<IntsOf<Float4>>(static_cast<int32_t>(i)) : firstRightBins;
  }
  Candidate best;
  float leastCost = std::numeric_limits<float>::infinity();
  for (size_t axis = 0; axis < 3; ++axis)
    if (binning.factor[axis] > 0 && leastCosts[axis] < leastCost) {
      leastCost = leastCosts[axis];
      best = {axis, static_cast<uint32_t>(firstRightBins[axis])};
    }
  return best;
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
  const Candidate best = bestSplit(bins, binning);
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
