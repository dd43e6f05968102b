#include "bvh/wide_collapse.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "core/check.h"

namespace asdfvk {
namespace {

// Levels whose subtrees are tasks of their own.
constexpr uint32_t kParallelLevelCount = 10;
constexpr uint32_t kParallelWideLevelCount = 4;

float halfArea(const BvhNode& node) {
  const Vec3f size = node.max - node.min;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

WideCollapse::WideCollapse(std::span<const BvhNode> nodes)
    : nodes_(nodes), choices_(nodes.size()), nodeCountsBelow_(nodes.size(), 0) {
  ASDFVK_CHECK(!nodes.empty());
  chooseFrom(0, 0);
  countFrom(0, 0);
}

void WideCollapse::chooseFrom(uint32_t node, uint32_t level) {
  if (!nodes_[node].isLeaf()) {
    const uint32_t left = nodes_[node].first;
    if (level < kParallelLevelCount) {
      tbb::parallel_invoke([&] { chooseFrom(left, level + 1); }, [&] { chooseFrom(left + 1, level + 1); });
    } else {
      chooseFrom(left, level + 1);
      chooseFrom(left + 1, level + 1);
    }
  }
  choices_[node] = choose(node);
}

WideCollapse::Choice WideCollapse::choose(uint32_t node) const {
  Choice choice;
  const float area = halfArea(nodes_[node]);
  if (nodes_[node].isLeaf()) {
    ASDFVK_CHECK_OP(nodes_[node].triangleCount, <=, kMaxWideLeafTriangleCount);
    choice.slots = {nodes_[node].first, nodes_[node].triangleCount};
    choice.isLeaf = true;
    choice.costs.fill(area * static_cast<float>(choice.slots.count));
    return choice;
  }
  const Choice &left = choices_[nodes_[node].first], &right = choices_[nodes_[node].first + 1];
  choice.slots = {left.slots.first, left.slots.count + right.slots.count};
  std::array<float, kWideChildCount + 1> shared{};  // [i]: i children from both sides
  for (uint32_t i = 2; i <= kWideChildCount; ++i) {
    for (uint32_t k = 1; k < i; ++k) {
      const float cost = left.costs[k] + right.costs[i - k];
      if (k > 1 && cost >= shared[i]) continue;
      shared[i] = cost;
      choice.leftCounts[i] = static_cast<uint8_t>(k);
    }
  }
  choice.costs[1] = shared[kWideChildCount] + area * kWideNodeCost;
  if (choice.slots.count <= kMaxWideLeafTriangleCount) {
    const float leafCost = area * static_cast<float>(choice.slots.count);
    choice.isLeaf = leafCost <= choice.costs[1];
    if (choice.isLeaf) choice.costs[1] = leafCost;
  }
  for (uint32_t i = 2; i < kWideChildCount; ++i) {
    choice.costs[i] = shared[i];
    if (choice.costs[i - 1] > shared[i]) continue;
    choice.costs[i] = choice.costs[i - 1];
    choice.leftCounts[i] = 0;
  }
  return choice;
}

void WideCollapse::addRoots(uint32_t node, uint32_t rootCount, WideChildren& children) const {
  const Choice& choice = choices_[node];
  while (rootCount > 1 && choice.leftCounts[rootCount] == 0) --rootCount;
  if (rootCount == 1) return children.add({node, choice.isLeaf});
  addRoots(nodes_[node].first, choice.leftCounts[rootCount], children);
  addRoots(nodes_[node].first + 1, rootCount - choice.leftCounts[rootCount], children);
}

WideChildren WideCollapse::childrenOf(uint32_t node) const {
  WideChildren children;
  if (nodes_[node].isLeaf()) {
    children.add({node, true});
    return children;
  }
  const uint32_t leftCount = choices_[node].leftCounts[kWideChildCount];
  addRoots(nodes_[node].first, leftCount, children);
  addRoots(nodes_[node].first + 1, kWideChildCount - leftCount, children);
  return children;
}

uint32_t WideCollapse::countFrom(uint32_t node, uint32_t level) {
  const WideChildren children = childrenOf(node);
  std::array<uint32_t, kWideChildCount> counts{};
  const auto count = [&](uint32_t i) {
    if (!children.items[i].isLeaf) counts[i] = 1 + countFrom(children.items[i].node, level + 1);
  };
  if (level < kParallelWideLevelCount)
    tbb::parallel_for(0u, children.count, count);
  else
    for (uint32_t i = 0; i < children.count; ++i) count(i);
  uint32_t sum = 0;
  for (const uint32_t c : counts) sum += c;
  return nodeCountsBelow_[node] = sum;
}

}  // namespace asdfvk
