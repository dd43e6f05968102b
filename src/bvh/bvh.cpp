#include "bvh/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "bvh/sah.h"
#include "bvh/small_tree.h"
#include "core/check.h"
#include "core/free_memory.h"
#include "core/parallel.h"
#include "core/unset_vector.h"

namespace asdfvk {
namespace {

constexpr size_t kBlockFaceCount = 4096;

// A float at or below d, and at or below d rounded to nearest. Branch-free: subtracts a bound of the rounding error.
float roundedDown(double d) { return static_cast<float>(d - std::abs(d) * 0x1p-23 - 0x1p-149); }

// The box contains the corners both in double and after rounding to float.
SplitBox outerBox(const TriangleMesh& mesh, const Face& face, const Normalization& normalization) {
  const Vec3d &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
  const auto least = [](double x, double y, double z) { return std::min(std::min(x, y), z); };
  const auto greatest = [](double x, double y, double z) { return std::max(std::max(x, y), z); };
  const Vec3d min = normalization.toNormalized({least(a.x, b.x, c.x), least(a.y, b.y, c.y), least(a.z, b.z, c.z)});
  const Vec3d max =
      normalization.toNormalized({greatest(a.x, b.x, c.x), greatest(a.y, b.y, c.y), greatest(a.z, b.z, c.z)});
  const Float4 lower = {roundedDown(min.x), roundedDown(min.y), roundedDown(min.z), 0};
  const Float4 negatedUpper = {roundedDown(-max.x), roundedDown(-max.y), roundedDown(-max.z), 0};
  return {lower, negatedUpper};
}

bool isFinite(const SplitBox& box) {
  bool finite = true;
  for (size_t axis = 0; axis < 3; ++axis)
    finite = finite && std::isfinite(box.lower[axis]) && std::isfinite(box.negatedUpper[axis]);
  return finite;
}

UnsetVector<SplitTriangle> collectTriangles(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                            std::span<const uint32_t> representatives,
                                            const Normalization& normalization) {
  UnsetVector<SplitTriangle> triangles(mesh.faces.size());
  std::vector<size_t> counts((mesh.faces.size() + kBlockFaceCount - 1) / kBlockFaceCount);
  forEachTask(counts.size(), [&](size_t block) {
    const size_t begin = block * kBlockFaceCount, end = std::min(begin + kBlockFaceCount, mesh.faces.size());
    SplitTriangle* next = &triangles[begin];
    for (auto f = static_cast<uint32_t>(begin); f < end; ++f) {
      if (representatives[f] != f || geometry.isDegenerate(f)) continue;
      const SplitBox box = outerBox(mesh, mesh.faces[f], normalization);
      if (isFinite(box)) *next++ = {box, f};
    }
    counts[block] = static_cast<size_t>(next - &triangles[begin]);
  });
  size_t count = 0;
  for (size_t block = 0; block < counts.size(); ++block) {
    const size_t begin = block * kBlockFaceCount;
    if (count < begin) std::copy_n(&triangles[begin], counts[block], &triangles[count]);
    count += counts[block];
  }
  triangles.resize(count);
  return triangles;
}

/// A part of the hierarchy under construction: an inner node with two children, or a finished run of nodes.
struct Subtree {
  std::unique_ptr<Subtree> left, right;  ///< Both are set or both are null.
  SplitBox box;
  /// Set if there are no children. The first node is the root. Child indices are relative to the run.
  std::vector<BvhNode> nodes;
  uint32_t depth = 0;    ///< Levels below the root of the subtree.
  size_t nodeCount = 0;  ///< All nodes of the subtree, root included.
};

// Parts up to this size become one run of nodes, built by one thread.
constexpr size_t kSequentialTriangleCount = 4096;

// Upper bound of the levels that median splits and small trees need for `count` triangles.
uint32_t levelsOfMedianSplits(size_t count) {
  const size_t smallTreeCount = (count + kMaxSmallTreeCount - 1) / kMaxSmallTreeCount;
  return static_cast<uint32_t>(std::bit_width(smallTreeCount - 1) + kMaxSmallTreeCount - 1);
}

// Reorders the triangles and returns the number on the left. SAH may separate a single triangle; then median splits of
// the remaining triangles must stay within kMaxBvhDepth.
size_t splitTriangles(std::span<SplitTriangle> triangles, uint32_t level, const BvhOptions& options) {
  if (levelsOfMedianSplits(triangles.size()) < kMaxBvhDepth - level) {
    const size_t leftCount = splitBySah(triangles, options.binCount);
    if (leftCount > 0) return leftCount;
  }
  return splitAtMedian(triangles);
}

class RunBuilder {
 public:
  RunBuilder(const BvhOptions& options, std::span<uint32_t> primitiveFaces, Subtree& run)
      : options_(options), primitiveFaces_(primitiveFaces), run_(run) {}

  SplitBox build(size_t nodeIndex, std::span<SplitTriangle> triangles, uint32_t firstPrimitive, uint32_t level,
                 uint32_t depth) {
    if (triangles.size() <= kMaxSmallTreeCount) {
      if (options_.maxLeafTriangleCount >= kMaxSmallTreeCount)
        return writeLeaf(nodeIndex, triangles, firstPrimitive, depth);
      const SmallTree tree(triangles, options_.maxLeafTriangleCount);
      run_.depth = std::max(run_.depth, depth + tree[tree.root()].depth);
      write(tree, tree.root(), nodeIndex, triangles, firstPrimitive);
      return tree[tree.root()].box;
    }
    const size_t leftCount = splitTriangles(triangles, level, options_);
    const size_t children = addChildren();
    SplitBox box = build(children, triangles.first(leftCount), firstPrimitive, level + 1, depth + 1);
    box.grow(build(children + 1, triangles.subspan(leftCount), firstPrimitive + static_cast<uint32_t>(leftCount),
                   level + 1, depth + 1));
    run_.nodes[nodeIndex] = box.toNode(static_cast<uint32_t>(children), 0);
    return box;
  }

 private:
  SplitBox writeLeaf(size_t nodeIndex, std::span<const SplitTriangle> triangles, uint32_t firstPrimitive,
                     uint32_t depth) {
    SplitBox box = SplitBox::empty();
    for (size_t i = 0; i < triangles.size(); ++i) {
      box.grow(triangles[i].box);
      primitiveFaces_[firstPrimitive + i] = triangles[i].face();
    }
    run_.depth = std::max(run_.depth, depth);
    run_.nodes[nodeIndex] = box.toNode(firstPrimitive, static_cast<uint32_t>(triangles.size()));
    return box;
  }
  size_t addChildren() {
    run_.nodes.resize(run_.nodes.size() + 2);
    return run_.nodes.size() - 2;
  }
  // Returns the primitive after the triangles of the tree's node.
  uint32_t write(const SmallTree& tree, uint32_t treeNode, size_t nodeIndex, std::span<const SplitTriangle> triangles,
                 uint32_t primitive) {
    const SmallTree::Node& node = tree[treeNode];
    if (node.isLeaf) {
      run_.nodes[nodeIndex] = node.box.toNode(primitive, node.triangleCount);
      return writeFaces(tree, treeNode, triangles, primitive);
    }
    const size_t children = addChildren();
    run_.nodes[nodeIndex] = node.box.toNode(static_cast<uint32_t>(children), 0);
    return write(tree, node.right, children + 1, triangles, write(tree, node.left, children, triangles, primitive));
  }
  uint32_t writeFaces(const SmallTree& tree, uint32_t treeNode, std::span<const SplitTriangle> triangles,
                      uint32_t primitive) {
    const SmallTree::Node& node = tree[treeNode];
    if (node.triangleCount > 1)
      return writeFaces(tree, node.right, triangles, writeFaces(tree, node.left, triangles, primitive));
    primitiveFaces_[primitive] = triangles[treeNode].face();
    return primitive + 1;
  }

  const BvhOptions& options_;
  std::span<uint32_t> primitiveFaces_;
  Subtree& run_;
};

/// Builds over `triangles`, and reorders them. primitiveFaces: the array of all primitives; one entry per triangle is
/// written, from `firstPrimitive` on. level: number of levels above this part. Large parts are separate tasks. The
/// result does not depend on the number of threads.
std::unique_ptr<Subtree> buildSubtree(std::span<SplitTriangle> triangles, std::span<uint32_t> primitiveFaces,
                                      uint32_t firstPrimitive, uint32_t level, const BvhOptions& options) {
  auto subtree = std::make_unique<Subtree>();
  if (triangles.size() <= kSequentialTriangleCount) {
    subtree->nodes.reserve(2 * triangles.size());
    subtree->nodes.resize(1);
    subtree->box = RunBuilder(options, primitiveFaces, *subtree).build(0, triangles, firstPrimitive, level, 0);
    subtree->nodes.shrink_to_fit();
    subtree->nodeCount = subtree->nodes.size();
    return subtree;
  }
  const size_t leftCount = splitTriangles(triangles, level, options);
  callBoth(
      [&] {
        subtree->left = buildSubtree(triangles.first(leftCount), primitiveFaces, firstPrimitive, level + 1, options);
      },
      [&] {
        subtree->right = buildSubtree(triangles.subspan(leftCount), primitiveFaces,
                                      firstPrimitive + static_cast<uint32_t>(leftCount), level + 1, options);
      });
  subtree->box = subtree->left->box;
  subtree->box.grow(subtree->right->box);
  subtree->depth = 1 + std::max(subtree->left->depth, subtree->right->depth);
  subtree->nodeCount = 1 + subtree->left->nodeCount + subtree->right->nodeCount;
  return subtree;
}

// A run of nodes and its destination: `index` for its root, `next` onwards for the others.
struct Placement {
  const std::vector<BvhNode>& run;
  uint32_t index = 0, next = 0;
};

// Assigns destinations to the runs of a subtree, and writes the nodes above the runs. The parent determines the index
// of a node. The descendants of a node start at `next`: first its two children, then all nodes below the left child,
// then all nodes below the right child. Returns the index after the subtree.
uint32_t place(const Subtree& subtree, uint32_t index, uint32_t next, std::span<BvhNode> nodes,
               std::vector<Placement>& placements) {
  if (!subtree.left) {
    placements.push_back({subtree.nodes, index, next});
    return next + static_cast<uint32_t>(subtree.nodes.size()) - 1;
  }
  nodes[index] = subtree.box.toNode(next, 0);
  const uint32_t afterLeft = place(*subtree.left, next, next + 2, nodes, placements);
  return place(*subtree.right, next + 1, afterLeft, nodes, placements);
}

UnsetVector<BvhNode> assemble(const Subtree& root) {
  UnsetVector<BvhNode> nodes(root.nodeCount);
  std::vector<Placement> placements;
  place(root, 0, 1, nodes, placements);
  forEachTask(placements.size(), [&](size_t p) {
    const auto& [run, index, next] = placements[p];
    for (size_t i = 0; i < run.size(); ++i) {
      BvhNode node = run[i];
      if (!node.isLeaf()) node.first += next - 1;
      nodes[i == 0 ? index : next + i - 1] = node;
    }
  });
  return nodes;
}

}  // namespace

Bvh buildBvh(const TriangleMesh& mesh, const FaceGeometry& geometry, std::span<const uint32_t> representatives,
             const BvhOptions& options) {
  ASDFVK_CHECK_OP(representatives.size(), ==, mesh.faces.size());
  ASDFVK_CHECK_OP(options.maxLeafTriangleCount, >, 0u);
  ASDFVK_CHECK_OP(options.maxLeafTriangleCount, <=, kMaxLeafTriangleCount);
  Bvh bvh;
  bvh.normalization = normalizationOf(geometry.bounds);
  UnsetVector<SplitTriangle> triangles = collectTriangles(mesh, geometry, representatives, bvh.normalization);
  if (triangles.empty()) return bvh;
  bvh.primitiveFaces.resize(triangles.size());
  const std::unique_ptr<Subtree> root = buildSubtree(triangles, bvh.primitiveFaces, 0, 0, options);
  freeMemory(triangles);
  bvh.depth = root->depth;
  bvh.nodes = assemble(*root);
  return bvh;
}

}  // namespace asdfvk
