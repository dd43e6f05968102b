#include "bvh/wide_collapse.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>

#include "core/box3.h"
#include "core/check.h"
#include "core/simd.h"

namespace asdfvk {
namespace {

// Levels whose subtrees are tasks of their own.
constexpr uint32_t kParallelSearchLevelCount = 10;

float halfAreaOf(const BvhNode& node) { return Box3f{node.min, node.max}.halfArea(); }

// [i - 1]: the least cost of i children from both sides, and how many of them come from the left one.
struct Sharing {
  std::array<float, kWideChildCount> costs;
  std::array<int32_t, kWideChildCount> leftCounts;
};

// All i at a time, k from the left one by one; ties go to the least k. More than maxLeftCount are never cheaper.
Sharing shareChildren(const std::array<float, kWideChildCount>& left, uint32_t maxLeftCount,
                      const std::array<float, kWideChildCount>& right) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 2 * kWideChildCount> padded;  // No child from the right is no choice.
  std::fill_n(padded.begin(), kWideChildCount, kInfinity);
  std::copy(right.begin(), right.end(), padded.begin() + kWideChildCount);
  Sharing sharing;
  for (size_t half = 0; half < kWideChildCount; half += 4) {
    Float4 least = broadcast<Float4>(kInfinity);
    IntsOf<Float4> leftCount{};
    for (uint32_t k = 1; k <= maxLeftCount; ++k) {
      const Float4 cost = load<Float4>(&padded[kWideChildCount + half - k]) + left[k - 1];
      const IntsOf<Float4> isLess = cost < least;
      least = isLess ? cost : least;
      leftCount = isLess ? broadcast<IntsOf<Float4>>(static_cast<int32_t>(k)) : leftCount;
    }
    store(&sharing.costs[half], least);
    store(&sharing.leftCounts[half], leftCount);
  }
  return sharing;
}

}  // namespace

WideCollapse::WideCollapse(std::span<const BvhNode> nodes) : nodes_(nodes), choices_(nodes.size()) {
  ASDFVK_CHECK(!nodes.empty());
  Forests forests;
  chooseFrom(0, 0, forests);
}

void WideCollapse::chooseFrom(uint32_t node, uint32_t level, Forests& forests) {
  if (nodes_[node].isLeaf()) {
    ASDFVK_CHECK_OP(nodes_[node].triangleCount, <=, kMaxWideLeafTriangleCount);
    forests.costs.fill(halfAreaOf(nodes_[node]) * static_cast<float>(nodes_[node].triangleCount));
    forests.nodeCounts.fill(0);
    return;
  }
  const uint32_t child = nodes_[node].first;
  Forests left, right;
  if (level < kParallelSearchLevelCount) {
    tbb::parallel_invoke([&] { chooseFrom(child, level + 1, left); }, [&] { chooseFrom(child + 1, level + 1, right); });
  } else {
    chooseFrom(child, level + 1, left);
    chooseFrom(child + 1, level + 1, right);
  }
  choose(node, left, right, forests);
}

void WideCollapse::choose(uint32_t node, const Forests& left, const Forests& right, Forests& forests) {
  Choice& choice = choices_[node];
  const SlotRange leftSlots = slotsOf(nodes_[node].first), rightSlots = slotsOf(nodes_[node].first + 1);
  choice.slots = {leftSlots.first, leftSlots.count + rightSlots.count};
  const uint32_t maxLeftCount =
      nodes_[nodes_[node].first].isLeaf() ? 1 : std::min(leftSlots.count, kWideChildCount - 1);
  const Sharing sharing = shareChildren(left.costs, maxLeftCount, right.costs);
  const auto nodeCount = [&](uint32_t childCount) {
    const auto k = static_cast<uint32_t>(sharing.leftCounts[childCount - 1]);
    return left.nodeCounts[k - 1] + right.nodeCounts[childCount - k - 1];
  };
  const float area = halfAreaOf(nodes_[node]), leafCost = area * static_cast<float>(choice.slots.count);
  choice.nodeCountBelow = nodeCount(kWideChildCount);
  choice.leftCounts = static_cast<uint32_t>(sharing.leftCounts.back()) << 4 * (kWideChildCount - 1);
  forests.costs[0] = sharing.costs.back() + area * kWideNodeCost;
  forests.nodeCounts[0] = 1 + choice.nodeCountBelow;
  if (choice.slots.count <= kMaxWideLeafTriangleCount && leafCost <= forests.costs[0]) {
    choice.leftCounts |= 1;
    forests.costs[0] = leafCost;
    forests.nodeCounts[0] = 0;
  }
  for (uint32_t i = 2; i < kWideChildCount; ++i) {
    const bool isCheaper = sharing.costs[i - 1] < forests.costs[i - 2];
    forests.costs[i - 1] = isCheaper ? sharing.costs[i - 1] : forests.costs[i - 2];
    forests.nodeCounts[i - 1] = isCheaper ? nodeCount(i) : forests.nodeCounts[i - 2];
    if (isCheaper) choice.leftCounts |= static_cast<uint32_t>(sharing.leftCounts[i - 1]) << 4 * (i - 1);
  }
}

void WideCollapse::addRoots(uint32_t node, uint32_t rootCount, WideChildren& children) const {
  if (nodes_[node].isLeaf()) return children.add({node, true});
  const Choice& choice = choices_[node];
  while (rootCount > 1 && choice.leftCount(rootCount) == 0) --rootCount;
  if (rootCount == 1) return children.add({node, (choice.leftCounts & 1) != 0});
  addRoots(nodes_[node].first, choice.leftCount(rootCount), children);
  addRoots(nodes_[node].first + 1, rootCount - choice.leftCount(rootCount), children);
}

WideChildren WideCollapse::childrenOf(uint32_t node) const {
  WideChildren children;
  if (nodes_[node].isLeaf()) {
    children.add({node, true});
    return children;
  }
  const uint32_t leftCount = choices_[node].leftCount(kWideChildCount);
  addRoots(nodes_[node].first, leftCount, children);
  addRoots(nodes_[node].first + 1, kWideChildCount - leftCount, children);
  return children;
}

}  // namespace asdfvk
