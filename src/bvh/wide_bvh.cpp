#include "bvh/wide_bvh.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "bvh/wide_boxes.h"
#include "bvh/wide_collapse.h"
#include "bvh/wide_slots.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr uint32_t kParallelLevelCount = 4;

Box3f boxOf(const BvhNode& node) { return {node.min, node.max}; }

// Writes the wide nodes. A parent determines the indices of its children.
class WideEncoder {
 public:
  WideEncoder(std::span<const BvhNode> nodes, std::span<const uint32_t> primitiveFaces)
      : nodes_(nodes), primitiveFaces_(primitiveFaces), collapse_(nodes) {
    bvh_.nodes.resize(1 + collapse_.nodeCountBelow(0));
    bvh_.primitiveFaces.resize(primitiveFaces.size());
    bvh_.depth = encode(0, 0, 1, 0, 0);
  }
  WideBvh take() { return std::move(bvh_); }

 private:
  // Writes descendants to nodes from `next` on, and triangles from `primitive` on. Returns the levels below the node.
  uint32_t encode(uint32_t binaryNode, uint32_t index, uint32_t next, uint32_t primitive, uint32_t level) {
    const WideChildren children = collapse_.childrenOf(binaryNode);
    std::array<Box3f, kWideChildCount> boxes;
    for (uint32_t i = 0; i < children.count; ++i) boxes[i] = boxOf(nodes_[children.items[i].node]);
    const std::span<const Box3f> used = std::span(boxes).first(children.count);
    const std::array<uint32_t, kWideChildCount> slots = chooseSlots(used);
    DeviceWideNode node = quantizeBoxes(used, slots);
    node.childBase = next;
    node.triangleBase = primitive;

    struct Inner {
      uint32_t binaryNode, index, next, primitive;
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
      const WideCollapse::PrimitiveRange range = collapse_.primitivesOf(inSlot[s].node);
      if (inSlot[s].isLeaf) {
        node.childBits |= ((1u << range.count) - 1) << 4 * s;
        std::copy_n(primitiveFaces_.begin() + range.first, range.count, bvh_.primitiveFaces.begin() + primitive);
        primitive += range.count;
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
      child.primitive = primitive;
      next += collapse_.nodeCountBelow(child.binaryNode);
      primitive += collapse_.primitivesOf(child.binaryNode).count;
    }
    std::array<uint32_t, kWideChildCount> depths{};
    const auto descend = [&](uint32_t i) {
      depths[i] = 1 + encode(inner[i].binaryNode, inner[i].index, inner[i].next, inner[i].primitive, level + 1);
    };
    if (level < kParallelLevelCount)
      forEachTask(innerCount, [&](size_t i) { descend(static_cast<uint32_t>(i)); });
    else
      for (uint32_t i = 0; i < innerCount; ++i) descend(i);
    return *std::max_element(depths.begin(), depths.end());
  }

  std::span<const BvhNode> nodes_;
  std::span<const uint32_t> primitiveFaces_;
  WideCollapse collapse_;
  WideBvh bvh_;
};

}  // namespace

WideBvh encodeWideBvh(const Bvh& bvh) {
  if (bvh.nodes.empty()) return {};
  WideBvh wide = WideEncoder(bvh.nodes, bvh.primitiveFaces).take();
  ASDFVK_CHECK_OP(wide.depth, <=, kMaxBvhDepth);
  return wide;
}

}  // namespace asdfvk
