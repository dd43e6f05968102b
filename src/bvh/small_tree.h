#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "bvh/split_box.h"
#include "core/simd.h"

namespace asdfvk {

/// As many triangles as a SmallTree holds.
inline constexpr size_t kMaxSmallTreeCount = 8;

/// A hierarchy over very few triangles, made from below: again and again, clusters that are each other's nearest become
/// one, where near means a small common box (as in Meister and Bittner 2018, among all instead of among neighbours).
/// That is faster there than splitting from above, and no worse.
class SmallTree {
 public:
  /// triangles: 1 to kMaxSmallTreeCount. A cluster of up to maxLeafTriangleCount is a leaf where that is no dearer.
  /// The same on each instruction set. Precondition: this machine has it.
  SmallTree(std::span<const SplitTriangle> triangles, uint32_t maxLeafTriangleCount,
            InstructionSet instructionSet = widestInstructionSet());

  struct Node {
    SplitBox box;
    float cost = 0;  ///< Expected, by the surface-area heuristic, times its area.
    uint8_t left = 0, right = 0;
    uint8_t triangleCount = 1, depth = 0;
    bool isLeaf = true;
  };
  [[nodiscard]] uint32_t root() const { return root_; }
  /// Nodes below triangles.size() are a triangle each, the others have two children.
  [[nodiscard]] const Node& operator[](uint32_t node) const { return nodes_[node]; }

 private:
  [[nodiscard]] uint32_t merge(uint32_t left, uint32_t right);

  uint32_t maxLeafTriangleCount_, root_ = 0, nodeEnd_;
  std::array<Node, 2 * kMaxSmallTreeCount> nodes_;
};

}  // namespace asdfvk
