#pragma once

#include <array>
#include <cstdint>

#include "bvh/bvh.h"
#include "bvh/wide_bvh.h"
#include "core/unset_vector.h"

namespace asdfvk {

/// Boxes of a node and triangles of a block, tested side by side against one ray.
inline constexpr uint32_t kBvhLaneCount = 8;

/// Up to eight children. Slots as chooseSlots() assigns them; in a slot without a child the lower corner is above the
/// upper one, so that no ray enters. 256 bytes.
struct alignas(64) LaneNode {
  std::array<std::array<std::array<float, kBvhLaneCount>, 2>, 3> planes;  ///< Per axis: the lower ones, the upper ones.
  std::array<uint32_t, kBvhLaneCount> children;                           ///< A node, or a block | kLaneBlockBit.
};
static_assert(sizeof(LaneNode) == 256);

inline constexpr uint32_t kLaneBlockBit = 0x8000'0000u;

/// A leaf: up to eight triangles, which are consecutive primitives of the Bvh. Unused lanes have no area. 320 bytes.
struct alignas(64) LaneBlock {
  std::array<std::array<std::array<float, kBvhLaneCount>, 3>, 3> corners;  ///< Per corner: x, y, z.
  uint32_t firstPrimitive;
  uint32_t triangleCount;
};
static_assert(sizeof(LaneBlock) == 320);

/// The hierarchy for the lanes of a CPU, in float32: corners are rounded to nearest, boxes are those of the Bvh. Node 0
/// is the root; empty without triangles.
struct LaneBvh {
  UnsetVector<LaneNode> nodes;
  UnsetVector<LaneBlock> blocks;
  uint32_t depth = 0;  ///< Levels below the root.
};

/// Entries of the stack of a traversal that pushes all children of a node that a ray enters.
inline constexpr uint32_t kLaneStackSize = kBvhLaneCount + (kBvhLaneCount - 1) * (kMaxBvhDepth + 1);

/// Costs of the collapse: a block of triangles is tested in 1.2 times the time of a node.
inline constexpr WideCosts kLaneCosts{.node = 1, .leaf = 1.2f, .triangle = 0, .maxLeafTriangleCount = kBvhLaneCount};

/// Collapses `bvh` by WideCollapse with kLaneCosts. Parallel, with the same result for any thread count.
[[nodiscard]] LaneBvh encodeLaneBvh(const Bvh& bvh, const TriangleMesh& mesh);

}  // namespace asdfvk
