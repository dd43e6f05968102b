#include "bvh/wide_collapse.h"

#include <algorithm>
#include <limits>

#include "core/box3.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

// Subtrees whose level is less than this are separate tasks.
constexpr uint32_t kParallelSearchLevelCount = 10;

float halfAreaOf(const BvhNode& node) { return Box3f{node.min, node.max}.halfArea(); }

// Entry [i - 1]: the least cost of i children from both sides, and the number of these children from the left side.
struct Sharing {
  std::array<float, kWideChildCount> costs;
  std::array<uint32_t, kWideChildCount> leftCounts;
};

// If costs are equal, the least number of children from the left side counts. More than maxLeftCount children from
// there are never cheaper.
Sharing shareChildren(const std::array<float, kWideChildCount>& left, uint32_t maxLeftCount,
                      const std::array<float, kWideChildCount>& right) {
  Sharing sharing{};
  sharing.costs.fill(std::numeric_limits<float>::infinity());
  for (uint32_t i = 2; i <= kWideChildCount; ++i) {
    for (uint32_t k = 1; k <= std::min(maxLeftCount, i - 1); ++k) {
      const float cost = left[k - 1] + right[i - k - 1];
      if (cost >= sharing.costs[i - 1]) continue;
      sharing.costs[i - 1] = cost;
      sharing.leftCounts[i - 1] = k;
    }
  }
  return sharing;
}

}  // namespace

WideCollapse::WideCollapse(std::span<const BvhNode> nodes, const WideCosts& costs)
    : nodes_(nodes), costs_(costs), choices_(nodes.size()) {
  ASDFVK_CHECK(!nodes.empty());
  Forests forests;
  chooseFrom(0, 0, forests);
}

void WideCollapse::chooseFrom(uint32_t node, uint32_t level, Forests& forests) {
  if (nodes_[node].isLeaf()) {
    ASDFVK_CHECK_OP(nodes_[node].triangleCount, <=, costs_.maxLeafTriangleCount);
    forests.costs.fill(halfAreaOf(nodes_[node]) * costs_.ofLeaf(nodes_[node].triangleCount));
    forests.nodeCounts.fill(0);
    return;
  }
  const uint32_t child = nodes_[node].first;
  Forests left, right;
  if (level < kParallelSearchLevelCount) {
    callBoth([&] { chooseFrom(child, level + 1, left); }, [&] { chooseFrom(child + 1, level + 1, right); });
  } else {
    chooseFrom(child, level + 1, left);
    chooseFrom(child + 1, level + 1, right);
  }
  choose(node, left, right, forests);
}

void WideCollapse::choose(uint32_t node, const Forests& left, const Forests& right, Forests& forests) {
  Choice& choice = choices_[node];
  const PrimitiveRange leftPrimitives = primitivesOf(nodes_[node].first),
                       rightPrimitives = primitivesOf(nodes_[node].first + 1);
  choice.primitives = {leftPrimitives.first, leftPrimitives.count + rightPrimitives.count};
  const uint32_t maxLeftCount =
      nodes_[nodes_[node].first].isLeaf() ? 1 : std::min(leftPrimitives.count, kWideChildCount - 1);
  const Sharing sharing = shareChildren(left.costs, maxLeftCount, right.costs);
  const auto nodeCount = [&](uint32_t childCount) {
    const uint32_t k = sharing.leftCounts[childCount - 1];
    return left.nodeCounts[k - 1] + right.nodeCounts[childCount - k - 1];
  };
  const float area = halfAreaOf(nodes_[node]), leafCost = area * costs_.ofLeaf(choice.primitives.count);
  choice.nodeCountBelow = nodeCount(kWideChildCount);
  choice.leftCounts = sharing.leftCounts.back() << 4 * (kWideChildCount - 1);
  forests.costs[0] = sharing.costs.back() + area * costs_.node;
  forests.nodeCounts[0] = 1 + choice.nodeCountBelow;
  if (choice.primitives.count <= costs_.maxLeafTriangleCount && leafCost <= forests.costs[0]) {
    choice.leftCounts |= 1;
    forests.costs[0] = leafCost;
    forests.nodeCounts[0] = 0;
  }
  for (uint32_t i = 2; i < kWideChildCount; ++i) {
    const bool isCheaper = sharing.costs[i - 1] < forests.costs[i - 2];
    forests.costs[i - 1] = isCheaper ? sharing.costs[i - 1] : forests.costs[i - 2];
    forests.nodeCounts[i - 1] = isCheaper ? nodeCount(i) : forests.nodeCounts[i - 2];
    if (isCheaper) choice.leftCounts |= sharing.leftCounts[i - 1] << 4 * (i - 1);
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
