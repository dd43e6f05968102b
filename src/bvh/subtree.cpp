#include "bvh/subtree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>

#include "bvh/binned_sah.h"
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

// Reorders and returns how many triangles go left. SAH may take off a single one, after which median splits must fit.
size_t splitTriangles(std::span<SplitTriangle> triangles, uint32_t level, const BvhOptions& options) {
  if (levelsOfMedianSplits(triangles.size()) < kMaxBvhDepth - level) {
    const size_t leftCount = splitBySah(triangles, options.binCount);
    if (leftCount > 0) return leftCount;
  }
  return splitAtMedian(triangles);
}

class RunBuilder {
 public:
  RunBuilder(const BvhOptions& options, std::span<uint32_t> slotFaces, Subtree& run)
      : options_(options), slotFaces_(slotFaces), run_(run) {}

  // Returns the box of the triangles.
  SplitBox build(size_t nodeIndex, std::span<SplitTriangle> triangles, uint32_t firstSlot, uint32_t level,
                 uint32_t depth) {
    if (triangles.size() <= kMaxSmallTreeCount) {
      const SmallTree tree(triangles, options_.maxLeafTriangleCount);
      run_.depth = std::max(run_.depth, depth + tree[tree.root()].depth);
      write(tree, tree.root(), nodeIndex, triangles, firstSlot);
      return tree[tree.root()].box;
    }
    const size_t leftCount = splitTriangles(triangles, level, options_);
    const size_t children = addChildren();
    SplitBox box = build(children, triangles.first(leftCount), firstSlot, level + 1, depth + 1);
    box.grow(build(children + 1, triangles.subspan(leftCount), firstSlot + static_cast<uint32_t>(leftCount), level + 1,
                   depth + 1));
    run_.nodes[nodeIndex] = box.toNode(static_cast<uint32_t>(children), 0);
    return box;
  }

 private:
  size_t addChildren() {
    run_.nodes.resize(run_.nodes.size() + 2);
    return run_.nodes.size() - 2;
  }
  // Returns the slot behind the triangles of the tree's node.
  uint32_t write(const SmallTree& tree, uint32_t treeNode, size_t nodeIndex, std::span<const SplitTriangle> triangles,
                 uint32_t slot) {
    const SmallTree::Node& node = tree[treeNode];
    if (node.isLeaf) {
      run_.nodes[nodeIndex] = node.box.toNode(slot, node.triangleCount);
      return writeFaces(tree, treeNode, triangles, slot);
    }
    const size_t children = addChildren();
    run_.nodes[nodeIndex] = node.box.toNode(static_cast<uint32_t>(children), 0);
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

std::unique_ptr<Subtree> buildSubtree(std::span<SplitTriangle> triangles, std::span<uint32_t> slotFaces,
                                      uint32_t firstSlot, uint32_t level, const BvhOptions& options) {
  auto subtree = std::make_unique<Subtree>();
  if (triangles.size() <= kSequentialTriangleCount) {
    subtree->nodes.reserve(2 * triangles.size());
    subtree->nodes.resize(1);
    subtree->box = RunBuilder(options, slotFaces, *subtree).build(0, triangles, firstSlot, level, 0);
    subtree->nodes.shrink_to_fit();
    subtree->nodeCount = subtree->nodes.size();
    return subtree;
  }
  const size_t leftCount = splitTriangles(triangles, level, options);
  tbb::parallel_invoke(
      [&] { subtree->left = buildSubtree(triangles.first(leftCount), slotFaces, firstSlot, level + 1, options); },
      [&] {
        subtree->right = buildSubtree(triangles.subspan(leftCount), slotFaces,
                                      firstSlot + static_cast<uint32_t>(leftCount), level + 1, options);
      });
  subtree->box = subtree->left->box;
  subtree->box.grow(subtree->right->box);
  subtree->depth = 1 + std::max(subtree->left->depth, subtree->right->depth);
  subtree->nodeCount = 1 + subtree->left->nodeCount + subtree->right->nodeCount;
  return subtree;
}

}  // namespace asdfvk
