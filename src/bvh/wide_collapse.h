#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "core/unset_vector.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Costs of the surface-area heuristic for wide nodes. Unit: the time of a triangle test on a device.
struct WideCosts {
  float node = 2;
  float leaf = 0;      ///< Fixed cost of a leaf.
  float triangle = 1;  ///< Further cost for each triangle of a leaf.
  uint32_t maxLeafTriangleCount = kMaxWideLeafTriangleCount;

  [[nodiscard]] float ofLeaf(uint32_t triangleCount) const {
    return leaf + triangle * static_cast<float>(triangleCount);
  }
};

/// A binary node that is a child of a wide node. It becomes a wide node, or a leaf with all triangles below it.
struct WideChild {
  uint32_t node = 0;
  bool isLeaf = false;
};

/// The children of one wide node, from left to right in the binary hierarchy.
struct WideChildren {
  std::array<WideChild, kWideChildCount> items;
  uint32_t count = 0;
  void add(const WideChild& child) { items[count++] = child; }
  [[nodiscard]] std::span<const WideChild> all() const { return std::span(items).first(count); }
};

/// Collapses a binary hierarchy: selects the binary nodes that become wide nodes with up to eight children, or leaves.
/// Minimises the cost by the surface-area heuristic (Ylitie, Karras and Laine 2017, section 3.1).
class WideCollapse {
 public:
  /// nodes: those of a Bvh, at least one, with at most costs.maxLeafTriangleCount triangles per leaf. The nodes must
  /// outlive this object. Parallel, with the same result for any thread count.
  explicit WideCollapse(std::span<const BvhNode> nodes, const WideCosts& costs = {});

  /// Children of the wide node that replaces a binary node. A root that is a leaf becomes the only child of a wide
  /// node.
  [[nodiscard]] WideChildren childrenOf(uint32_t node) const;
  struct PrimitiveRange {
    uint32_t first = 0, count = 0;
  };
  [[nodiscard]] PrimitiveRange primitivesOf(uint32_t node) const {
    return nodes_[node].isLeaf() ? PrimitiveRange{nodes_[node].first, nodes_[node].triangleCount}
                                 : choices_[node].primitives;
  }
  [[nodiscard]] uint32_t nodeCountBelow(uint32_t node) const {
    return nodes_[node].isLeaf() ? 0 : choices_[node].nodeCountBelow;
  }

 private:
  // Cheapest ways to collapse a binary subtree into at most i children of a wide node, i = 1 to 7, in entry [i - 1].
  struct Forests {
    std::array<float, kWideChildCount> costs;
    std::array<uint32_t, kWideChildCount> nodeCounts;
  };
  struct Choice {
    // Nibble i - 1, for i = 2 to 8 children: the number of these children below the left child; 0 if i - 1 children are
    // as cheap. Nibble 0: 1 if the node becomes a leaf when it is a single child.
    uint32_t leftCounts;
    uint32_t nodeCountBelow;
    PrimitiveRange primitives;
    [[nodiscard]] uint32_t leftCount(uint32_t childCount) const { return leftCounts >> 4 * (childCount - 1) & 15; }
  };

  void chooseFrom(uint32_t node, uint32_t level, Forests& forests);
  void choose(uint32_t node, const Forests& left, const Forests& right, Forests& forests);
  void addRoots(uint32_t node, uint32_t rootCount, WideChildren& children) const;

  std::span<const BvhNode> nodes_;
  WideCosts costs_;
  UnsetVector<Choice> choices_;  // Per binary node; unset for leaves.
};

}  // namespace asdfvk
