#include "bvh/small_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/check.h"

namespace asdfvk {
namespace {

using Nearest = std::array<int32_t, kMaxSmallTreeCount>;

// Clusters that are not merged yet.
struct Clusters {
  uint32_t count = 0;
  std::array<uint8_t, kMaxSmallTreeCount> nodes;
  std::array<std::array<float, kMaxSmallTreeCount>, 6> bounds{};  // The layout of SplitBox.

  void add(uint32_t node, const SplitBox& box) {
    nodes[count] = static_cast<uint8_t>(node);
    for (size_t axis = 0; axis < 3; ++axis) {
      bounds[axis][count] = box.lower[axis];
      bounds[axis + 3][count] = box.negatedUpper[axis];
    }
    ++count;
  }
};

// If pairs have equal distances, the first pair by (smaller index, greater index) counts. Therefore the first of the
// nearest pairs is mutual.
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline void findNearest(const Clusters& clusters, Nearest& nearest) {
  using Ints = IntsOf<Floats>;
  Ints lane;
  for (size_t l = 0; l < kLaneCount<Floats>; ++l) lane[l] = static_cast<int32_t>(l);
  for (size_t begin = 0; begin < clusters.count; begin += kLaneCount<Floats>) {
    Floats own[6];
    for (size_t k = 0; k < 6; ++k) own[k] = load<Floats>(&clusters.bounds[k][begin]);
    Floats least = broadcast<Floats>(std::numeric_limits<float>::max());
    Ints choice{};
    for (size_t other = 0; other < clusters.count; ++other) {
      Floats extents[3];
      for (size_t axis = 0; axis < 3; ++axis)
        extents[axis] = min(own[axis], broadcast<Floats>(clusters.bounds[axis][other])) +
                        min(own[axis + 3], broadcast<Floats>(clusters.bounds[axis + 3][other]));
      const Floats area = extents[0] * extents[1] + extents[1] * extents[2] + extents[2] * extents[0];
      const Ints isNearer = (area < least) & (lane != static_cast<int32_t>(other - begin));
      least = isNearer ? area : least;
      choice = isNearer ? broadcast<Ints>(static_cast<int32_t>(other)) : choice;
    }
    store(&nearest[begin], choice);
  }
}

}  // namespace

SmallTree::SmallTree(std::span<const SplitTriangle> triangles, uint32_t maxLeafTriangleCount,
                     InstructionSet instructionSet)
    : maxLeafTriangleCount_(maxLeafTriangleCount), nodeEnd_(static_cast<uint32_t>(triangles.size())) {
  ASDFVK_CHECK(!triangles.empty() && triangles.size() <= kMaxSmallTreeCount);
  Clusters clusters;
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const SplitBox& box = triangles[i].box;
    nodes_[i].box = box;
    nodes_[i].cost = box.halfArea() * kTriangleCost;
    clusters.add(i, box);
  }
  while (clusters.count > 2) {
    Nearest nearest;
    dispatch<Float8>(instructionSet,
                     [&]<typename Floats>() ASDFVK_ALWAYS_INLINE { findNearest<Floats>(clusters, nearest); });
    const uint32_t count = std::exchange(clusters.count, 0);
    for (uint32_t i = 0; i < count; ++i) {
      const auto other = static_cast<uint32_t>(nearest[i]);
      const bool isMutual = static_cast<uint32_t>(nearest[other]) == i;
      if (isMutual && other < i) continue;
      const uint32_t node = isMutual ? merge(clusters.nodes[i], clusters.nodes[other]) : clusters.nodes[i];
      clusters.add(node, nodes_[node].box);
    }
  }
  root_ = clusters.count == 1 ? clusters.nodes[0] : merge(clusters.nodes[0], clusters.nodes[1]);
}

uint32_t SmallTree::merge(uint32_t left, uint32_t right) {
  const Node &l = nodes_[left], &r = nodes_[right];
  Node& node = nodes_[nodeEnd_];
  node.box = l.box;
  node.box.grow(r.box);
  node.left = static_cast<uint8_t>(left);
  node.right = static_cast<uint8_t>(right);
  node.triangleCount = l.triangleCount + r.triangleCount;
  const float area = node.box.halfArea(), leafCost = area * kTriangleCost * node.triangleCount;
  node.cost = area * kNodeCost + l.cost + r.cost;
  node.isLeaf = node.triangleCount <= maxLeafTriangleCount_ && leafCost <= node.cost;
  if (node.isLeaf) node.cost = leafCost;
  node.depth = node.isLeaf ? 0 : 1 + std::max(l.depth, r.depth);
  return nodeEnd_++;
}

}  // namespace asdfvk
