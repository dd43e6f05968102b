#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "bvh/sah.h"
#include "core/simd.h"

namespace asdfvk {

inline constexpr size_t kMaxSmallTreeCount = 8;

/// A hierarchy over few triangles, built by agglomerative clustering (Meister and Bittner 2018, but with all clusters
/// as candidates). Each pass merges the pairs of clusters that are mutual nearest neighbours. The distance of two
/// clusters is the area of their common box. For so few triangles, clustering is faster than top-down splitting, and
/// the tree has no higher cost.
class SmallTree {
 public:
  /// triangles: 1 to kMaxSmallTreeCount. A cluster of up to maxLeafTriangleCount triangles becomes a leaf unless that
  /// raises the cost. All instruction sets give the same tree. Precondition: the processor has `instructionSet`.
  SmallTree(std::span<const SplitTriangle> triangles, uint32_t maxLeafTriangleCount,
            InstructionSet instructionSet = widestInstructionSet());

  struct Node {
    SplitBox box;
    float cost = 0;  ///< Cost by the surface-area heuristic, times the half area of the box.
    uint8_t left = 0, right = 0;
    uint8_t triangleCount = 1, depth = 0;
    bool isLeaf = true;
  };
  [[nodiscard]] uint32_t root() const { return root_; }
  /// Nodes with an index below triangles.size() are single triangles. The other nodes have two children.
  [[nodiscard]] const Node& operator[](uint32_t node) const { return nodes_[node]; }

 private:
  [[nodiscard]] uint32_t merge(uint32_t left, uint32_t right);

  uint32_t maxLeafTriangleCount_, root_ = 0, nodeEnd_;
  std::array<Node, 2 * kMaxSmallTreeCount> nodes_;
};

}  // namespace asdfvk
