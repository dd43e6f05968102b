#include "bvh/wide_bvh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "bvh/wide_collapse.h"
#include "bvh/wide_node.h"
#include "core/check.h"

namespace asdfvk {
namespace {

constexpr uint32_t kParallelLevelCount = 4;

Box3f boxOf(const BvhNode& node) { return {node.min, node.max}; }

// Halves leaves until none is too large; the halves come behind all nodes.
UnsetVector<BvhNode> withSmallLeaves(UnsetVector<BvhNode> nodes) {
  for (size_t i = 0; i < nodes.size(); ++i) {
    const BvhNode leaf = nodes[i];
    if (leaf.triangleCount <= kMaxWideLeafTriangleCount) continue;
    const uint32_t half = leaf.triangleCount / 2;
    nodes[i] = {leaf.min, static_cast<uint32_t>(nodes.size()), leaf.max, 0};
    nodes.push_back({leaf.min, leaf.first, leaf.max, half});
    nodes.push_back({leaf.min, leaf.first + half, leaf.max, leaf.triangleCount - half});
  }
  return nodes;
}

// Writes the wide nodes, each to where its parent says.
class WideEncoder {
 public:
  WideEncoder(std::span<const BvhNode> nodes, std::span<const uint32_t> slotFaces)
      : nodes_(nodes), slotFaces_(slotFaces), collapse_(nodes) {
    bvh_.nodes.resize(1 + collapse_.nodeCountBelow(0));
    bvh_.slotFaces.resize(slotFaces.size());
    bvh_.depth = encode(0, 0, 1, 0, 0);
  }
  WideBvh take() { return std::move(bvh_); }

 private:
  // All below it goes to nodes from `next` and triangles from `slot` on. Returns the levels below it.
  uint32_t encode(uint32_t binaryNode, uint32_t index, uint32_t next, uint32_t slot, uint32_t level) {
    const WideChildren children = collapse_.childrenOf(binaryNode);
    std::array<Box3f, kWideChildCount> boxes;
    for (uint32_t i = 0; i < children.count; ++i) boxes[i] = boxOf(nodes_[children.items[i].node]);
    const std::span<const Box3f> used = std::span(boxes).first(children.count);
    const std::array<uint32_t, kWideChildCount> slots = chooseSlots(used);
    DeviceWideNode node = quantizeBoxes(used, slots);
    node.childBase = next;
    node.triangleBase = slot;

    struct Inner {
      uint32_t binaryNode, index, next, slot;
    };
    std::array<WideChild, kWideChildCount> inSlot{};
    std::array<bool, kWideChildCount> isUsed{};
    for (uint32_t i = 0; i < children.count; ++i) {
      inSlot[slots[i]] = children.items[i];
      isUsed[slots[i]] = true;
    }
    std::array<Inner, kWideChildCount> inner{};
    uint32_t innerCount = 0;
    for (uint32_t s = 0; s < kWideChildCount; ++s) {
      if (!isUsed[s]) continue;
      const WideCollapse::SlotRange range = collapse_.slotsOf(inSlot[s].node);
      if (inSlot[s].isLeaf) {
        node.childBits |= ((1u << range.count) - 1) << 4 * s;
        std::copy_n(slotFaces_.begin() + range.first, range.count, bvh_.slotFaces.begin() + slot);
        slot += range.count;
      } else {
        node.childBits |= kWideInnerBits & 0xfu << 4 * s;
        inner[innerCount] = {inSlot[s].node, next + innerCount, 0, 0};
        ++innerCount;
      }
    }
    bvh_.nodes[index] = node;
    next += innerCount;
    for (Inner& child : std::span(inner).first(innerCount)) {
      child.next = next;
      child.slot = slot;
      next += collapse_.nodeCountBelow(child.binaryNode);
      slot += collapse_.slotsOf(child.binaryNode).count;
    }
    std::array<uint32_t, kWideChildCount> depths{};
    const auto descend = [&](uint32_t i) {
      depths[i] = 1 + encode(inner[i].binaryNode, inner[i].index, inner[i].next, inner[i].slot, level + 1);
    };
    if (level < kParallelLevelCount)
      tbb::parallel_for(0u, innerCount, descend);
    else
      for (uint32_t i = 0; i < innerCount; ++i) descend(i);
    return *std::max_element(depths.begin(), depths.end());
  }

  std::span<const BvhNode> nodes_;
  std::span<const uint32_t> slotFaces_;
  WideCollapse collapse_;
  WideBvh bvh_;
};

}  // namespace

WideBvh encodeWideBvh(const Bvh& bvh) {
  const bool hasLargeLeaves = std::any_of(bvh.nodes.begin(), bvh.nodes.end(), [](const BvhNode& node) {
    return node.triangleCount > kMaxWideLeafTriangleCount;
  });
  WideBvh wide = hasLargeLeaves ? WideEncoder(withSmallLeaves(bvh.nodes), bvh.slotFaces).take()
                                : WideEncoder(bvh.nodes, bvh.slotFaces).take();
  ASDFVK_CHECK_OP(wide.depth, <=, kMaxWideBvhDepth);
  return wide;
}

}  // namespace asdfvk
