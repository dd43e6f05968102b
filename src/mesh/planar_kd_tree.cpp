#include "mesh/planar_kd_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asdfvk {
namespace {

constexpr uint32_t kLeafSize = 6;

}  // namespace

PlanarKdTree::PlanarKdTree(std::span<const Point2> points) : order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!points.empty()) build(points, 0, static_cast<uint32_t>(points.size()));
}

uint32_t PlanarKdTree::build(std::span<const Point2> points, uint32_t begin, uint32_t end) {
  const uint32_t index = static_cast<uint32_t>(nodes_.size());
  Node node{points[order_[begin]], points[order_[begin]], begin, end, 0};
  for (uint32_t i = begin; i < end; ++i) {
    const Point2& p = points[order_[i]];
    node.min = {std::min(node.min.x, p.x), std::min(node.min.y, p.y)};
    node.max = {std::max(node.max.x, p.x), std::max(node.max.y, p.y)};
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return index;
  const bool splitX = node.max.x - node.min.x >= node.max.y - node.min.y;
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](uint32_t a, uint32_t b) {
    return splitX ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  build(points, begin, middle);
  const uint32_t upper = build(points, middle, end);
  nodes_[index].upperChild = upper;
  return index;
}

// The separating axis test of a box and a triangle: the box's two axes, then the triangle's three edges.
bool PlanarKdTree::mayTouch(const Node& node, const std::array<Point2, 3>& triangle) {
  const auto [minX, maxX] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
  const auto [minY, maxY] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  if (maxX < node.min.x || minX > node.max.x || maxY < node.min.y || minY > node.max.y) return false;
  const double winding = sideOf(triangle[0], triangle[1], triangle[2]) < 0 ? -1 : 1;
  for (size_t i = 0; i < 3; ++i) {
    const Point2 &a = triangle[i], &b = triangle[(i + 1) % 3];
    const double nx = -(b.y - a.y) * winding, ny = (b.x - a.x) * winding;  // Points into the triangle.
    const Point2 innermost{nx > 0 ? node.max.x : node.min.x, ny > 0 ? node.max.y : node.min.y};
    // A tolerance far above rounding, so that no point inside is missed.
    const double slack = 1e-12 * (std::abs(nx) + std::abs(ny));
    if (nx * (innermost.x - a.x) + ny * (innermost.y - a.y) < -slack) return false;
  }
  return true;
}

}  // namespace asdfvk
