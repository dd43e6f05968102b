#pragma once

#include <cstdint>
#include <span>

#include "core/box3.h"
#include "core/unset_vector.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// 32 bytes. Boxes are in normalised coordinates and rounded outwards: a box contains the corners of its triangles both
/// in double and after rounding to float.
struct BvhNode {
  Vec3f min;
  uint32_t first = 0;  ///< Inner: index of the left child; the right child follows. Leaf: first primitive.
  Vec3f max;
  uint32_t triangleCount = 0;  ///< 0 for an inner node.

  [[nodiscard]] bool isLeaf() const { return triangleCount > 0; }
};

/// A binary bounding volume hierarchy. nodes[0] is the root; `nodes` is empty without triangles.
struct Bvh {
  UnsetVector<BvhNode> nodes;
  UnsetVector<uint32_t> primitiveFaces;  ///< Face index of each primitive. No face occurs twice.
  uint32_t depth = 0;                    ///< Levels below the root.
  Normalization normalization;
};

/// Relative costs of the surface-area heuristic: of a node (two box tests) and of a triangle test.
inline constexpr float kNodeCost = 1.0f;
inline constexpr float kTriangleCost = 1.0f;

/// Greatest number of triangles in a leaf. Only the layout of the CPU (lane_bvh.h) takes leaves of more than
/// kMaxWideLeafTriangleCount triangles.
inline constexpr uint32_t kMaxLeafTriangleCount = 8;

struct BvhOptions {
  /// 1 to kMaxLeafTriangleCount.
  uint32_t maxLeafTriangleCount = kMaxWideLeafTriangleCount;
  uint32_t binCount = 16;  ///< Bins per axis, 2 to 32. Small sets of triangles use fewer bins.

  bool operator==(const BvhOptions&) const = default;
};

/// Binned surface-area heuristic (Wald 2007), parallel over subtrees, with the same result for any thread count.
/// Contains a face if it is not degenerate and is its own representative (see coincidentRepresentatives()). Omits faces
/// with non-finite normalised corners, which occur in meshes as wide as the range of double.
[[nodiscard]] Bvh buildBvh(const TriangleMesh& mesh, const FaceGeometry& geometry,
                           std::span<const uint32_t> representatives, const BvhOptions& options = {});

}  // namespace asdfvk
