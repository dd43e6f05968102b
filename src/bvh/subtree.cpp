#include "bvh/subtree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>

#include "bvh/small_tree.h"

namespace asdfvk {
namespace {

// Parts up to this size are built by one thread, into one run of nodes.
constexpr size_t kSequentialTriangleCount = 4096;

// Levels that median splits and small trees need for `count` triangles, at most.
uint32_t levelsOfMedianSplits(size_t count) {
  const size_t smallTreeCount = (count + kMaxSmallTreeCount - 1) / kMaxSmallTreeCount;
  return static_cast<uint32_t>(std::bit_width(smallTreeCount - 1) + kMaxSmallTreeCount - 1);
}

// SAH may take off a single triangle, after which median splits must still fit.
Split splitTriangles(std::span<SplitTriangle> triangles, const SplitBounds& bounds, uint32_t level,
                     const BvhOptions& options) {
  if (levelsOfMedianSplits(triangles.size()) < kMaxBvhDepth - level) {
    const Split split = splitBySah(triangles, bounds, options.binCount);
    if (split.leftCount > 0) return split;
  }
  return splitAtMedian(triangles, bounds);
}

class RunBuilder {
 public:
  RunBuilder(const BvhOptions& options, std::span<uint32_t> slotFaces, Subtree& run)
      : options_(options), slotFaces_(slotFaces), run_(run) {}

  void build(size_t nodeIndex, std::span<SplitTriangle> triangles, const SplitBounds& bounds, uint32_t firstSlot,
             uint32_t level, uint32_t depth) {
    if (triangles.size() <= kMaxSmallTreeCount) {
      const SmallTree tree(triangles, options_.maxLeafTriangleCount);
      run_.depth = std::max(run_.depth, depth + tree[tree.root()].depth);
      write(tree, tree.root(), nodeIndex, triangles, firstSlot);
      return;
    }
    const Split split = splitTriangles(triangles, bounds, level, options_);
    const size_t children = addChildren(nodeIndex, bounds.box);
    build(children, triangles.first(split.leftCount), split.left, firstSlot, level + 1, depth + 1);
    build(children + 1, triangles.subspan(split.leftCount), split.right,
          firstSlot + static_cast<uint32_t>(split.leftCount), level + 1, depth + 1);
  }

 private:
  size_t addChildren(size_t nodeIndex, const SplitBox& box) {
    const size_t children = run_.nodes.size();
    run_.nodes[nodeIndex] = box.toNode(static_cast<uint32_t>(children), 0);
    run_.nodes.resize(children + 2);
    return children;
  }
  // Returns the slot behind the triangles of the tree's node.
  uint32_t write(const SmallTree& tree, uint32_t treeNode, size_t nodeIndex, std::span<const SplitTriangle> triangles,
                 uint32_t slot) {
    const SmallTree::Node& node = tree[treeNode];
    if (node.isLeaf) {
      run_.nodes[nodeIndex] = node.box.toNode(slot, node.triangleCount);
      return writeFaces(tree, treeNode, triangles, slot);
    }
    const size_t children = addChildren(nodeIndex, node.box);
    return write(tree, node.right, children + 1, triangles, write(tree, node.left, children, triangles, slot));
  }
  uint32_t writeFaces(const SmallTree& tree, uint32_t treeNode, std::span<const SplitTriangle> triangles,
                      uint32_t slot) {
    const SmallTree::Node& node = tree[treeNode];
    if (node.triangleCount > 1)
      return writeFaces(tree, node.right, triangles, writeFaces(tree, node.left, triangles, slot));
    slotFaces_[slot] = triangles[treeNode].face();
    return slot + 1;
  }

  const BvhOptions& options_;
  std::span<uint32_t> slotFaces_;
  Subtree& run_;
};

}  // namespace

std::unique_ptr<Subtree> buildSubtree(std::span<SplitTriangle> triangles, const SplitBounds& bounds,
                                      std::span<uint32_t> slotFaces, uint32_t firstSlot, uint32_t level,
                                      const BvhOptions& options) {
  auto subtree = std::make_unique<Subtree>();
  if (triangles.size() <= kSequentialTriangleCount) {
    subtree->nodes.reserve(2 * triangles.size());
    subtree->nodes.resize(1);
    RunBuilder(options, slotFaces, *subtree).build(0, triangles, bounds, firstSlot, level, 0);
    subtree->nodes.shrink_to_fit();
    subtree->nodeCount = subtree->nodes.size();
    return subtree;
  }
  const Split split = splitTriangles(triangles, bounds, level, options);
  tbb::parallel_invoke(
      [&] {
        subtree->left =
            buildSubtree(triangles.first(split.leftCount), split.left, slotFaces, firstSlot, level + 1, options);
      },
      [&] {
        subtree->right = buildSubtree(triangles.subspan(split.leftCount), split.right, slotFaces,
                                      firstSlot + static_cast<uint32_t>(split.leftCount), level + 1, options);
      });
  subtree->box = bounds.box;
  subtree->depth = 1 + std::max(subtree->left->depth, subtree->right->depth);
  subtree->nodeCount = 1 + subtree->left->nodeCount + subtree->right->nodeCount;
  return subtree;
}

}  // namespace asdfvk
