#pragma once

#include <array>
#include <cstdint>

#include "bvh/bvh.h"

namespace asdfvk {

/// Whether the box of a node is within `distance` of another box on each axis.
template <typename Box>
[[nodiscard]] bool overlaps(const BvhNode& node, const Box& box, double distance = 0) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (node.min[axis] > box.max[axis] + distance || node.max[axis] < box.min[axis] - distance) return false;
  return true;
}

/// Calls visit(face) for each primitive face of each leaf for which reaches(node) is true, until visit() returns false.
/// Precondition: reaches(node) is true for all nodes above a leaf for which it is true.
template <typename Reaches, typename Visit>
void forEachLeafFace(const Bvh& bvh, const Reaches& reaches, const Visit& visit) {
  std::array<uint32_t, kMaxBvhDepth + 1> stack;
  size_t stackSize = 0;
  if (!bvh.nodes.empty()) stack[stackSize++] = 0;
  while (stackSize > 0) {
    const BvhNode& node = bvh.nodes[stack[--stackSize]];
    if (!reaches(node)) continue;
    if (!node.isLeaf()) {
      stack[stackSize++] = node.first;
      stack[stackSize++] = node.first + 1;
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.triangleCount; ++i)
      if (!visit(bvh.primitiveFaces[i])) return;
  }
}

}  // namespace asdfvk
