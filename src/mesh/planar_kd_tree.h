#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point2.h"

namespace asdfvk {

/// A k-d tree of points in the plane; finds the points that a triangle may contain.
class PlanarKdTree {
 public:
  explicit PlanarKdTree(std::span<const Point2> points);

  /// Calls visit(index) for every point inside the triangle, and for some points near it.
  template <typename Visit>
  void forEachNear(const std::array<Point2, 3>& triangle, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, triangle, visit);
  }

 private:
  struct Node {
    Point2 min, max;
    uint32_t begin = 0, end = 0;  // Range in order_.
    uint32_t upperChild = 0;      // 0 for a leaf. The lower child is the next node.
  };

  uint32_t build(std::span<const Point2> points, uint32_t begin, uint32_t end);
  [[nodiscard]] static bool mayTouch(const Node& node, const std::array<Point2, 3>& triangle);

  template <typename Visit>
  void descend(uint32_t index, const std::array<Point2, 3>& triangle, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (!mayTouch(node, triangle)) return;
    if (node.upperChild == 0) {
      for (uint32_t i = node.begin; i < node.end; ++i) visit(order_[i]);
      return;
    }
    descend(index + 1, triangle, visit);
    descend(node.upperChild, triangle, visit);
  }

  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace asdfvk
