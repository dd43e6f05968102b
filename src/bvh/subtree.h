#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bvh/bvh.h"
#include "bvh/split_box.h"

namespace asdfvk {

/// A part of the hierarchy under construction: either an inner node with two children, or a finished run of nodes.
struct Subtree {
  std::unique_ptr<Subtree> left, right;  ///< Both or none.
  SplitBox box;
  std::vector<BvhNode> nodes;  ///< Without children: root first; inner nodes count from this run's start.
  uint32_t depth = 0;          ///< Levels below its root.
  size_t nodeCount = 0;        ///< All nodes of the subtree, root included.
};

/// Builds over `triangles`, which it reorders. slotFaces: of all slots; those from
/// `firstSlot` on are written, one per triangle. level: the number of levels above. Large parts run as tasks of their
/// own; what comes out does not depend on that.
[[nodiscard]] std::unique_ptr<Subtree> buildSubtree(std::span<SplitTriangle> triangles, std::span<uint32_t> slotFaces,
                                                    uint32_t firstSlot, uint32_t level, const BvhOptions& options);

}  // namespace asdfvk
