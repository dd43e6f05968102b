#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/bvh.h"

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
  std::array<WideChild, kWideChildCount> items{};
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
  [[nodiscard]] SlotRange slotsOf(uint32_t node) const { return choices_[node].slots; }
  /// The wide nodes below the wide node that the binary one becomes, itself not counted.
  [[nodiscard]] uint32_t nodeCountBelow(uint32_t node) const { return nodeCountsBelow_[node]; }

 private:
  // What is cheapest for a subtree of the binary hierarchy that becomes at most i children of a wide node above it.
  struct Choice {
    std::array<float, kWideChildCount> costs{};  // [i] for i = 1 to 7.
    // [i]: of i children so many come from the left child; 0: it is as cheap with i - 1. For i = 8 of its own children.
    std::array<uint8_t, kWideChildCount + 1> leftCounts{};
    bool isLeaf = false;  // As a single child.
    SlotRange slots;
  };

  void chooseFrom(uint32_t node, uint32_t level);
  [[nodiscard]] Choice choose(uint32_t node) const;
  void addRoots(uint32_t node, uint32_t rootCount, WideChildren& children) const;
  uint32_t countFrom(uint32_t node, uint32_t level);

  std::span<const BvhNode> nodes_;
  std::vector<Choice> choices_;            // Per binary node.
  std::vector<uint32_t> nodeCountsBelow_;  // Per binary node; of those that become wide ones.
};

}  // namespace asdfvk
