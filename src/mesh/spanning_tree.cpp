#include "mesh/spanning_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/box3.h"
#include "core/disjoint_sets.h"

namespace asdfvk {
namespace {

constexpr uint32_t kLeafPointCount = 8, kNone = 0xffffffff;
constexpr uint32_t kStepsPerCheckpoint = 1024;
constexpr double kFarAway = std::numeric_limits<double>::infinity();

struct PointNode {
  Box3d box;
  uint32_t begin = 0, end = 0;  ///< Range of points.
  uint32_t left = kNone;        ///< Left child; the right child is the next node. kNone for a leaf.
  uint32_t group = kNone;  ///< The group of all points below the node; kNone if the points belong to several groups.
};

/// An edge from a point, and its squared length.
struct Edge {
  double square = kFarAway;
  uint32_t from = kNone, to = kNone;
};

class SpanningTree {
 public:
  SpanningTree(std::span<const Vec3d> points, const RunControl& control)
      : control_(control),
        order_(points.size()),
        sets_(points.size()),
        groups_(points.size()),
        nearest_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.push_back({.end = static_cast<uint32_t>(points.size())});
    for (uint32_t node = 0; node < nodes_.size(); ++node) {
      checkpointAt(node);
      split(points, node);
    }
    // The points are scaled so that squares neither overflow nor underflow.
    double greatest = 0;
    for (const Vec3d& p : points) greatest = std::max({greatest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const auto scaled = [&](const Vec3d& p) { return greatest > 0 ? p / greatest : p; };
    for (const uint32_t point : order_) points_.push_back(scaled(points[point]));
    for (PointNode& node : nodes_) node.box = {scaled(node.box.min), scaled(node.box.max)};
  }

  std::vector<std::array<uint32_t, 2>> run() {
    while (edges_.size() + 1 < points_.size()) joinGroups();
    return std::move(edges_);
  }

 private:
  void checkpointAt(uint32_t step) const {
    if (step % kStepsPerCheckpoint == 0)
      control_.checkpoint(static_cast<double>(edges_.size()) / static_cast<double>(order_.size()));
  }

  void split(std::span<const Vec3d> points, uint32_t index) {
    PointNode node = nodes_[index];
    for (uint32_t i = node.begin; i < node.end; ++i) node.box.add(points[order_[i]]);
    if (node.end - node.begin > kLeafPointCount) {
      const Vec3d size = node.box.halfSize();
      const size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      const uint32_t middle = node.begin + (node.end - node.begin) / 2;
      std::nth_element(order_.begin() + node.begin, order_.begin() + middle, order_.begin() + node.end,
                       [&](uint32_t a, uint32_t b) {
                         return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
                       });
      node.left = static_cast<uint32_t>(nodes_.size());
      nodes_.push_back({.begin = node.begin, .end = middle});
      nodes_.push_back({.begin = middle, .end = node.end});
    }
    nodes_[index] = node;
  }

  /// One round of Borůvka's algorithm: adds the shortest edge of each group to another group.
  void joinGroups() {
    for (uint32_t i = 0; i < groups_.size(); ++i) groups_[i] = sets_.lowestOf(i);
    for (size_t index = nodes_.size(); index-- > 0;) {  // Children follow their parents.
      PointNode& node = nodes_[index];
      node.group = node.left == kNone ? groups_[node.begin] : nodes_[node.left].group;
      if (node.left != kNone && nodes_[node.left + 1].group != node.group) node.group = kNone;
      for (uint32_t i = node.begin; node.left == kNone && i < node.end; ++i)
        if (groups_[i] != node.group) node.group = kNone;
    }
    std::vector<Edge> best(groups_.size());
    const auto offer = [&](const Edge& edge) {
      if (Edge& known = best[groups_[edge.from]]; edge.square < known.square) known = edge;
    };
    const auto isValid = [&](const Edge& edge) { return edge.to != kNone && groups_[edge.to] != groups_[edge.from]; };
    for (const Edge& edge : nearest_)
      if (isValid(edge)) offer(edge);
    for (uint32_t i = 0; i < groups_.size(); ++i) {
      checkpointAt(i);
      // The distance to the nearest point of another group never decreases from round to round.
      Edge& edge = nearest_[i];
      const double limit = best[groups_[i]].square, least = edge.from == kNone ? -1 : edge.square;
      if (isValid(edge) || least >= limit) continue;
      edge = nearestOfOthers(i, limit);
      if (edge.to != kNone) offer(edge);
    }
    std::erase_if(best, [](const Edge& edge) { return edge.to == kNone; });
    std::sort(best.begin(), best.end(), [](const Edge& a, const Edge& b) {
      return a.square != b.square ? a.square < b.square : a.from < b.from;
    });
    for (const Edge& edge : best)
      // Equally long edges may close a cycle.
      if (sets_.join(edge.from, edge.to)) edges_.push_back({order_[edge.from], order_[edge.to]});
  }

  /// The shortest edge from point i to another group, if its squared length is below `limit`. If there is no such edge,
  /// the result has the square `limit` and no `to`.
  [[nodiscard]] Edge nearestOfOthers(uint32_t i, double limit) const {
    const Vec3d& p = points_[i];
    Edge found{limit, i, kNone};
    std::array<uint32_t, 64> stack;  // The depth is below 32, because each split halves a node.
    size_t stackSize = 0;
    stack[stackSize++] = 0;
    while (stackSize > 0) {
      const PointNode& node = nodes_[stack[--stackSize]];
      if (node.group == groups_[i] || !(squaredDistanceToBox(node.box, p) < found.square)) continue;
      if (node.left == kNone) {
        for (uint32_t j = node.begin; j < node.end; ++j) {
          const Vec3d way = points_[j] - p;
          if (groups_[j] != groups_[i] && dot(way, way) < found.square) found = {dot(way, way), i, j};
        }
        continue;
      }
      const bool leftFirst =
          squaredDistanceToBox(nodes_[node.left].box, p) < squaredDistanceToBox(nodes_[node.left + 1].box, p);
      stack[stackSize++] = node.left + (leftFirst ? 1 : 0);
      stack[stackSize++] = node.left + (leftFirst ? 0 : 1);
    }
    return found;
  }

  const RunControl& control_;
  std::vector<uint32_t> order_;  ///< The caller's point at each position in the tree. All other indices are positions.
  std::vector<Vec3d> points_;
  std::vector<PointNode> nodes_;
  DisjointSets sets_;
  std::vector<uint32_t> groups_;  ///< The group of each point at the start of the round.
  std::vector<Edge> nearest_;     ///< Where `to` is of the same group or kNone, `square` is a lower bound.
  std::vector<std::array<uint32_t, 2>> edges_;
};

}  // namespace

std::vector<std::array<uint32_t, 2>> minimumSpanningTree(std::span<const Vec3d> points, const RunControl& control) {
  if (points.size() < 2) return {};
  return SpanningTree(points, control).run();
}

}  // namespace asdfvk
