#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "core/unset_vector.h"

namespace asdfvk {

/// What a wide node costs in the surface-area heuristic, in triangle tests.
inline constexpr float kWideNodeCost = 2.0f;

/// A child of a wide node: a node of the binary hierarchy, either to become a wide node itself or, with all that is
/// below it, a leaf.
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

/// Which nodes of a binary hierarchy become the nodes of one with eight children each, and which its leaves, so that
/// the expected cost of a ray by the surface-area heuristic is least: Ylitie, Karras and Laine 2017, section 3.1.
class WideCollapse {
 public:
  /// nodes: as in Bvh, at least one, leaves of at most kMaxWideLeafTriangleCount triangles; must outlive this. Runs in
  /// parallel; what it chooses does not depend on that.
  explicit WideCollapse(std::span<const BvhNode> nodes);

  /// Of the wide node that the binary node becomes. A root that is a leaf becomes one with itself as the only child.
  [[nodiscard]] WideChildren childrenOf(uint32_t node) const;
  /// Triangles below a binary node, in slots that follow each other.
  struct SlotRange {
    uint32_t first = 0, count = 0;
  };
  [[nodiscard]] SlotRange slotsOf(uint32_t node) const {
    return nodes_[node].isLeaf() ? SlotRange{nodes_[node].first, nodes_[node].triangleCount} : choices_[node].slots;
  }
  /// The wide nodes below the wide node that the binary one becomes, itself not counted.
  [[nodiscard]] uint32_t nodeCountBelow(uint32_t node) const {
    return nodes_[node].isLeaf() ? 0 : choices_[node].nodeCountBelow;
  }

 private:
  // Of a subtree of the binary hierarchy: [i - 1] as at most i children of a wide node above it, i = 1 to 7, what is
  // cheapest costs so much and has so many wide nodes.
  struct Forests {
    std::array<float, kWideChildCount> costs;
    std::array<uint32_t, kWideChildCount> nodeCounts;
  };
  // Of an inner node of the binary hierarchy.
  struct Choice {
    // Nibble i - 1: of i children so many come from the left child, i = 2 to 8; 0: it is as cheap with i - 1. The
    // lowest nibble: 1 where it is a leaf as a single child.
    uint32_t leftCounts;
    uint32_t nodeCountBelow;
    SlotRange slots;
    [[nodiscard]] uint32_t leftCount(uint32_t childCount) const { return leftCounts >> 4 * (childCount - 1) & 15; }
  };

  void chooseFrom(uint32_t node, uint32_t level, Forests& forests);
  void choose(uint32_t node, const Forests& left, const Forests& right, Forests& forests);
  void addRoots(uint32_t node, uint32_t rootCount, WideChildren& children) const;

  std::span<const BvhNode> nodes_;
  UnsetVector<Choice> choices_;  // Per binary node; unset for leaves.
};

}  // namespace asdfvk
