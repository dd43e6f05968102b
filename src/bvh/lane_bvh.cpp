#include "bvh/lane_bvh.h"

#include <algorithm>
#include <span>

#include "bvh/wide_slots.h"
#include "core/box3.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/prefetch.h"

namespace asdfvk {
namespace {

constexpr float kBeyondAll = 4;  // Outside of the normalised box, which ends at 1.

constexpr uint32_t kNoNode = ~0u;

/// Children of a node by slot. nodes: binary nodes. references: entries of LaneNode::children.
struct LaneChildren {
  std::array<uint32_t, kBvhLaneCount> nodes, references;
};

/// Places nodes and blocks in the order of a depth-first traversal.
class LaneLayout {
 public:
  explicit LaneLayout(const Bvh& bvh) : nodes_(bvh.nodes), collapse_(bvh.nodes, kLaneCosts) {
    children_.reserve(collapse_.nodeCountBelow(0) + 1);
    add(0, 0);
  }
  [[nodiscard]] const std::vector<LaneChildren>& children() const { return children_; }
  [[nodiscard]] const std::vector<WideCollapse::PrimitiveRange>& blocks() const { return blocks_; }
  [[nodiscard]] uint32_t depth() const { return depth_; }

 private:
  uint32_t add(uint32_t binaryNode, uint32_t level) {
    const auto index = static_cast<uint32_t>(children_.size());
    depth_ = std::max(depth_, level);
    children_.emplace_back();
    const WideChildren children = collapse_.childrenOf(binaryNode);
    std::array<Box3f, kBvhLaneCount> boxes;
    for (uint32_t i = 0; i < children.count; ++i) {
      const BvhNode& node = nodes_[children.items[i].node];
      boxes[i] = {node.min, node.max};
    }
    const std::array<uint32_t, kBvhLaneCount> slots = chooseSlots(std::span(boxes).first(children.count));
    LaneChildren bySlot;
    bySlot.nodes.fill(kNoNode);
    bySlot.references.fill(kLaneBlockBit);
    for (uint32_t i = 0; i < children.count; ++i) {
      const WideChild& child = children.items[i];
      bySlot.nodes[slots[i]] = child.node;
      bySlot.references[slots[i]] = child.isLeaf ? addBlock(child.node) : add(child.node, level + 1);
    }
    children_[index] = bySlot;
    return index;
  }
  uint32_t addBlock(uint32_t binaryNode) {
    blocks_.push_back(collapse_.primitivesOf(binaryNode));
    return static_cast<uint32_t>(blocks_.size() - 1) | kLaneBlockBit;
  }

  std::span<const BvhNode> nodes_;
  WideCollapse collapse_;
  std::vector<LaneChildren> children_;  // Per node.
  std::vector<WideCollapse::PrimitiveRange> blocks_;
  uint32_t depth_ = 0;
};

void fillNode(LaneNode& node, const LaneChildren& children, std::span<const BvhNode> nodes) {
  node.children = children.references;
  for (uint32_t slot = 0; slot < kBvhLaneCount; ++slot) {
    const uint32_t child = children.nodes[slot];
    for (size_t axis = 0; axis < 3; ++axis) {
      node.planes[axis][0][slot] = child == kNoNode ? kBeyondAll : nodes[child].min[axis];
      node.planes[axis][1][slot] = child == kNoNode ? -kBeyondAll : nodes[child].max[axis];
    }
  }
}

/// Prefetches the faces that prefetchVertices() and fillBlock() read.
void prefetchFaces(const WideCollapse::PrimitiveRange& range, const Bvh& bvh, const TriangleMesh& mesh) {
  for (uint32_t i = 0; i < range.count; ++i) prefetchMemory(&mesh.faces[bvh.primitiveFaces[range.first + i]]);
}

/// Prefetches the vertices that fillBlock() reads. This function reads the faces, so they must be prefetched earlier.
void prefetchVertices(const WideCollapse::PrimitiveRange& range, const Bvh& bvh, const TriangleMesh& mesh) {
  for (uint32_t i = 0; i < range.count; ++i)
    for (const uint32_t vertex : mesh.faces[bvh.primitiveFaces[range.first + i]])
      prefetchMemory(&mesh.vertices[vertex]);
}

void fillBlock(LaneBlock& block, const WideCollapse::PrimitiveRange& range, const Bvh& bvh, const TriangleMesh& mesh) {
  block = {.firstPrimitive = range.first, .triangleCount = range.count};
  for (uint32_t lane = 0; lane < range.count; ++lane) {
    const Face& face = mesh.faces[bvh.primitiveFaces[range.first + lane]];
    for (size_t k = 0; k < 3; ++k) {
      const Vec3f corner(bvh.normalization.toNormalized(mesh.vertices[face[k]]));
      for (size_t axis = 0; axis < 3; ++axis) block.corners[k][axis][lane] = corner[axis];
    }
  }
}

}  // namespace

LaneBvh encodeLaneBvh(const Bvh& bvh, const TriangleMesh& mesh) {
  if (bvh.nodes.empty()) return {};
  const LaneLayout layout(bvh);
  ASDFVK_CHECK_OP(layout.depth(), <=, kMaxBvhDepth);
  LaneBvh lanes{UnsetVector<LaneNode>(layout.children().size()), UnsetVector<LaneBlock>(layout.blocks().size()),
                layout.depth()};
  forEachInParallel(lanes.nodes.size(), [&](size_t i) { fillNode(lanes.nodes[i], layout.children()[i], bvh.nodes); });
  const std::vector<WideCollapse::PrimitiveRange>& blocks = layout.blocks();
  // Faces and vertices are prefetched this number of blocks ahead.
  constexpr size_t kFaceDistance = 4, kVertexDistance = 2;
  forEachInParallel(blocks.size(), [&](size_t i) {
    if (i + kFaceDistance < blocks.size()) prefetchFaces(blocks[i + kFaceDistance], bvh, mesh);
    if (i + kVertexDistance < blocks.size()) prefetchVertices(blocks[i + kVertexDistance], bvh, mesh);
    fillBlock(lanes.blocks[i], blocks[i], bvh, mesh);
  });
  return lanes;
}

}  // namespace asdfvk
