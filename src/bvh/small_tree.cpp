#include "bvh/small_tree.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/check.h"
#include "core/octet.h"

namespace asdfvk {

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
    if (instructionSet >= InstructionSet::Avx2) {
      findNearestWithAvx2(clusters, nearest);
    } else {
      findNearest<Quad, QuadIntegers>(clusters, nearest);
    }
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

void SmallTree::Clusters::add(uint32_t node, const SplitBox& box) {
  nodes[count] = static_cast<uint8_t>(node);
  for (size_t axis = 0; axis < 3; ++axis) {
    bounds[axis][count] = box.lower[axis];
    bounds[axis + 3][count] = box.negatedUpper[axis];
  }
  ++count;
}

// Of several that are as near, each takes the first pair of them in the order of (smaller index, greater index): so the
// first of the nearest pairs is mutual.
template <typename Floats, typename Integers>
[[gnu::always_inline]] inline void SmallTree::findNearest(const Clusters& clusters, Nearest& nearest) {
  constexpr size_t kWidth = sizeof(Floats) / sizeof(float);
  Integers lane;
  for (size_t l = 0; l < kWidth; ++l) lane[l] = static_cast<int32_t>(l);
  for (size_t begin = 0; begin < clusters.count; begin += kWidth) {
    Floats own[6];
    for (size_t k = 0; k < 6; ++k) std::memcpy(&own[k], &clusters.bounds[k][begin], sizeof own[k]);
    Floats least = Floats{} + std::numeric_limits<float>::max();
    Integers choice{};
    for (size_t other = 0; other < clusters.count; ++other) {
      Floats extents[3];
      for (size_t axis = 0; axis < 3; ++axis) {
        const float lower = clusters.bounds[axis][other], negatedUpper = clusters.bounds[axis + 3][other];
        extents[axis] = (own[axis] < lower ? own[axis] : Floats{} + lower) +
                        (own[axis + 3] < negatedUpper ? own[axis + 3] : Floats{} + negatedUpper);
      }
      const Floats area = extents[0] * extents[1] + extents[1] * extents[2] + extents[2] * extents[0];
      const Integers isNearer = (area < least) & (lane != static_cast<int32_t>(other - begin));
      least = isNearer ? area : least;
      choice = isNearer ? Integers{} + static_cast<int32_t>(other) : choice;
    }
    std::memcpy(&nearest[begin], &choice, sizeof choice);
  }
}

#ifdef __x86_64__
// The same operations, hence the same bits, in fewer instructions.
[[gnu::target("avx2")]] void SmallTree::findNearestWithAvx2(const Clusters& clusters, Nearest& nearest) {
  findNearest<Octet, OctetIntegers>(clusters, nearest);
}
#else
void SmallTree::findNearestWithAvx2(const Clusters&, Nearest&) { ASDFVK_CHECK(false); }
#endif

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
