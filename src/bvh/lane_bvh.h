#pragma once

#include <array>
#include <cstdint>

#include "bvh/bvh.h"
#include "bvh/wide_collapse.h"
#include "core/unset_vector.h"

namespace asdfvk {

/// Boxes of a node, or triangles of a block, that are tested together against one ray.
inline constexpr uint32_t kBvhLaneCount = 8;
static_assert(kMaxLeafTriangleCount <= kBvhLaneCount);

/// A node of 256 bytes with up to eight children, in the slots that chooseSlots() assigns. In an empty slot the lower
/// corner of the box is above the upper corner, so that no ray enters it.
struct alignas(64) LaneNode {
  /// [axis][0]: lower planes, [axis][1]: upper planes.
  std::array<std::array<std::array<float, kBvhLaneCount>, 2>, 3> planes;
  std::array<uint32_t, kBvhLaneCount> children;  ///< Index of a node, or index of a block with kLaneBlockBit.
};
static_assert(sizeof(LaneNode) == 256);

inline constexpr uint32_t kLaneBlockBit = 0x8000'0000u;

/// A leaf of 320 bytes: up to eight consecutive primitives of the Bvh. Triangles of unused lanes have zero area.
struct alignas(64) LaneBlock {
  std::array<std::array<std::array<float, kBvhLaneCount>, 3>, 3> corners;  ///< Per corner: x, y, z.
  uint32_t firstPrimitive;
  uint32_t triangleCount;
};
static_assert(sizeof(LaneBlock) == 320);

/// The hierarchy for the lanes of a CPU, in float32. Corners are rounded to nearest; boxes are those of the Bvh. Node 0
/// is the root; `nodes` is empty without triangles.
struct LaneBvh {
  UnsetVector<LaneNode> nodes;
  UnsetVector<LaneBlock> blocks;
  uint32_t depth = 0;  ///< Levels below the root.
};

/// Stack entries of a traversal that pushes all children of each node that the ray enters.
inline constexpr uint32_t kLaneStackSize = kBvhLaneCount + (kBvhLaneCount - 1) * (kMaxBvhDepth + 1);

/// For WideCollapse: testing a block of triangles takes 1.2 times as long as testing a node.
inline constexpr WideCosts kLaneCosts{.node = 1, .leaf = 1.2f, .triangle = 0, .maxLeafTriangleCount = kBvhLaneCount};

/// Collapses `bvh` by WideCollapse with kLaneCosts. Parallel, with the same result for any thread count.
[[nodiscard]] LaneBvh encodeLaneBvh(const Bvh& bvh, const TriangleMesh& mesh);

}  // namespace asdfvk
