#include "bvh/subtree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>

#include "bvh/binned_sah.h"

namespace asdfvk {
namespace {

// Parts up to this size are built by one thread, into one run of nodes.
constexpr size_t kSequentialTriangleCount = 8192;

// Levels that median splits need to bring `count` triangles down to leaves.
uint32_t levelsOfMedianSplits(size_t count, uint32_t maxLeafTriangleCount) {
  const size_t leafCount = (count + maxLeafTriangleCount - 1) / maxLeafTriangleCount;
  return static_cast<uint32_t>(std::bit_width(leafCount - 1));
}

// Reorders and returns how many triangles go left; 0 for a leaf.
size_t splitTriangles(std::span<SplitTriangle> triangles, const SplitBounds& bounds, uint32_t level,
                      const BvhOptions& options) {
  if (triangles.size() == 1) return 0;
  const bool leafAllowed = triangles.size() <= options.maxLeafTriangleCount;
  // SAH may take off a single triangle, after which median splits must still fit.
  if (levelsOfMedianSplits(triangles.size(), options.maxLeafTriangleCount) < kMaxBvhDepth - level) {
    const size_t leftCount = splitBySah(triangles, bounds, options.binCount, leafAllowed);
    if (leftCount > 0) return leftCount;
  }
  return leafAllowed ? 0 : splitAtMedian(triangles, bounds);
}

BvhNode makeNode(const SplitBox& box, uint32_t first, uint32_t triangleCount) {
  return {{box.min(0), box.min(1), box.min(2)}, first, {box.max(0), box.max(1), box.max(2)}, triangleCount};
}

class RunBuilder {
 public:
  RunBuilder(const BvhOptions& options, Subtree& run) : options_(options), run_(run) {}

  void build(size_t nodeIndex, std::span<SplitTriangle> triangles, uint32_t firstSlot, uint32_t level, uint32_t depth) {
    run_.depth = std::max(run_.depth, depth);
    const SplitBounds bounds = boundsOf(triangles);
    const size_t leftCount = splitTriangles(triangles, bounds, level, options_);
    if (leftCount == 0) {
      run_.nodes[nodeIndex] = makeNode(bounds.box, firstSlot, static_cast<uint32_t>(triangles.size()));
      return;
    }
    const size_t children = run_.nodes.size();
    run_.nodes[nodeIndex] = makeNode(bounds.box, static_cast<uint32_t>(children), 0);
    run_.nodes.resize(children + 2);
    build(children, triangles.first(leftCount), firstSlot, level + 1, depth + 1);
    build(children + 1, triangles.subspan(leftCount), firstSlot + static_cast<uint32_t>(leftCount), level + 1,
          depth + 1);
  }

 private:
  const BvhOptions& options_;
  Subtree& run_;
};

}  // namespace

std::unique_ptr<Subtree> buildSubtree(std::span<SplitTriangle> triangles, uint32_t firstSlot, uint32_t level,
                                      const BvhOptions& options) {
  auto subtree = std::make_unique<Subtree>();
  if (triangles.size() > std::max<size_t>(kSequentialTriangleCount, options.maxLeafTriangleCount)) {
    const SplitBounds bounds = boundsOf(triangles);
    const size_t leftCount = splitTriangles(triangles, bounds, level, options);
    subtree->box = bounds.box;
    tbb::parallel_invoke(
        [&] { subtree->left = buildSubtree(triangles.first(leftCount), firstSlot, level + 1, options); },
        [&] {
          subtree->right = buildSubtree(triangles.subspan(leftCount), firstSlot + static_cast<uint32_t>(leftCount),
                                        level + 1, options);
        });
    subtree->depth = 1 + std::max(subtree->left->depth, subtree->right->depth);
  } else {
    subtree->nodes.resize(1);
    RunBuilder(options, *subtree).build(0, triangles, firstSlot, level, 0);
  }
  return subtree;
}

}  // namespace asdfvk
