#include "bvh/bvh_statistics.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace asdfvk {
namespace {

double halfArea(const BvhNode& node) { return Box3d{Vec3d(node.min), Vec3d(node.max)}.halfArea(); }

}  // namespace

BvhStatistics computeBvhStatistics(const Bvh& bvh) {
  BvhStatistics statistics;
  if (bvh.nodes.empty()) return statistics;
  statistics.nodeCount = bvh.nodes.size();
  double cost = 0;
  std::vector<std::pair<uint32_t, uint32_t>> stack = {{0, 0}};  // Node and its level.
  while (!stack.empty()) {
    const auto [index, level] = stack.back();
    stack.pop_back();
    const BvhNode& node = bvh.nodes[index];
    statistics.depth = std::max(statistics.depth, level);
    if (node.isLeaf()) {
      ++statistics.leafCount;
      cost += halfArea(node) * kTriangleCost * node.triangleCount;
    } else {
      cost += halfArea(node) * kNodeCost;
      stack.push_back({node.first, level + 1});
      stack.push_back({node.first + 1, level + 1});
    }
  }
  statistics.sahCost = cost / halfArea(bvh.nodes[0]);
  return statistics;
}

}  // namespace asdfvk
