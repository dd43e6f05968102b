#include "mesh/cavities.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>

#include "core/box3.h"
#include "core/parallel.h"
#include "mesh/face_geometry.h"
#include "mesh/point2.h"

namespace asdfvk {
namespace {

constexpr uint32_t kLeafSize = 6;
/// Of the origins of rays, in contact distances: a face that touches another component lies on either side of it.
constexpr double kOriginDepth = 2;
/// Place of the origins between a corner, which is sharp, and the barycentre.
constexpr double kOriginShare = 0.25;

/// A k-d tree of points in the plane; finds the points that a triangle may contain.
class PlanePoints {
 public:
  explicit PlanePoints(std::span<const Point2> points);

  /// Calls visit(index) for every point inside the triangle, and for some points near it.
  template <typename Visit>
  void forEachNear(const std::array<Point2, 3>& triangle, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, triangle, visit);
  }

 private:
  struct Node {
    Point2 min, max;
    uint32_t begin = 0, end = 0;  // In order_.
    uint32_t upperChild = 0;      // 0: a leaf; the lower child is the next node.
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

PlanePoints::PlanePoints(std::span<const Point2> points) : order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!points.empty()) build(points, 0, static_cast<uint32_t>(points.size()));
}

uint32_t PlanePoints::build(std::span<const Point2> points, uint32_t begin, uint32_t end) {
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
bool PlanePoints::mayTouch(const Node& node, const std::array<Point2, 3>& triangle) {
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

// Rays run along the third axis of a frame that is not parallel to the axes, planes and diagonals along which meshes
// are often built.
struct ProjectionFrame {
  Normalization normalization;

  [[nodiscard]] Vec3d toFrame(const Vec3d& p) const {
    static constexpr Vec3d kX{0.80134262, -0.56937194, -0.18349152}, kY{0.50881031, 0.48112718, 0.71386211};
    static constexpr Vec3d kZ = cross(kX, kY);  // Nearly orthonormal, which is sufficient for parity.
    const Vec3d q = normalization.toNormalized(p);
    return {dot(kX, q), dot(kY, q), dot(kZ, q)};
  }
};

struct TestRay {
  uint32_t component = 0;
  Vec3d point;  // In the ray frame.
};

struct ClosedComponents {
  std::vector<Box3d> boxes;   // Empty for components that are not closed.
  std::vector<TestRay> rays;  // Grouped by component, ascending.
};

/// Inside of the component, next to the corner of a face; at the corner where the inside is uncertain.
Vec3d originAt(const TriangleMesh& mesh, size_t corner, const Component& component, double depth) {
  const Face& face = mesh.faces[corner / 3];
  const Vec3d &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
  const Vec3d& p = mesh.vertices[face[corner % 3]];
  const Vec3d normal = cross(b - a, c - a);
  const double norm = length(normal);
  if (!component.isConsistentlyWound || component.signedVolume == 0 || !(norm > 0) || !std::isfinite(norm)) return p;
  return p + kOriginShare * ((a + b + c) / 3.0 - p) - std::copysign(depth, component.signedVolume) * (normal / norm);
}

ClosedComponents gatherClosed(const TriangleMesh& mesh, const Components& components, const ProjectionFrame& frame) {
  const size_t count = components.components.size();
  ClosedComponents closed{std::vector<Box3d>(count), {}};
  std::vector<std::array<size_t, 6>> extremes(count);  // Corners: lowest, highest along x, y, z.
  const auto pointAt = [&](size_t corner) { return mesh.vertices[mesh.faces[corner / 3][corner % 3]]; };
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    const uint32_t component = components.componentOf[f];
    if (!components.components[component].isClosed) continue;
    std::array<size_t, 6>& extreme = extremes[component];
    if (closed.boxes[component].isEmpty()) extreme.fill(size_t{3} * f);
    for (size_t corner = size_t{3} * f; corner < size_t{3} * f + 3; ++corner) {
      const Vec3d p = pointAt(corner);
      closed.boxes[component].add(p);
      for (size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] < pointAt(extreme[2 * axis])[axis]) extreme[2 * axis] = corner;
        if (p[axis] > pointAt(extreme[2 * axis + 1])[axis]) extreme[2 * axis + 1] = corner;
      }
    }
  }
  for (uint32_t component = 0; component < count; ++component) {
    if (closed.boxes[component].isEmpty()) continue;
    std::array<size_t, 6>& extreme = extremes[component];
    std::sort(extreme.begin(), extreme.end());
    const auto end = std::unique(extreme.begin(), extreme.end());
    const double depth = kOriginDepth * frame.normalization.contactLength();
    for (auto corner = extreme.begin(); corner != end; ++corner)
      closed.rays.push_back(
          {component, frame.toFrame(originAt(mesh, *corner, components.components[component], depth))});
  }
  return closed;
}

// The side of p relative to an edge, computed from the lower vertex to the upper one, so that both faces of an edge
// have the same value: a ray that hits an edge crosses exactly one of them, independent of rounding.
double sideOfEdge(const Face& face, const std::array<Vec3d, 3>& corners, size_t i, const Vec3d& p) {
  const size_t j = (i + 1) % 3;
  const auto plane = [](const Vec3d& v) { return Point2{v.x, v.y}; };
  return face[i] < face[j] ? sideOf(plane(corners[i]), plane(corners[j]), plane(p))
                           : -sideOf(plane(corners[j]), plane(corners[i]), plane(p));
}

bool isOnPositiveSide(const Face& face, size_t i, double side) {
  return side > 0 || (side == 0 && face[i] < face[(i + 1) % 3]);
}

bool rayCrosses(const Face& face, const std::array<Vec3d, 3>& corners, const Vec3d& p) {
  std::array<double, 3> sides;
  std::array<bool, 3> isPositive;
  for (size_t i = 0; i < 3; ++i) {
    sides[i] = sideOfEdge(face, corners, i, p);
    isPositive[i] = isOnPositiveSide(face, i, sides[i]);
  }
  if (isPositive[0] != isPositive[1] || isPositive[1] != isPositive[2]) return false;
  const double sum = sides[0] + sides[1] + sides[2];
  if (sum == 0) return false;
  const double height = (sides[0] * corners[2].z + sides[1] * corners[0].z + sides[2] * corners[1].z) / sum;
  return height > p.z;
}

// For each test ray 1 where it crosses an odd number of faces of the components whose boxes contain the box of its own
// component. That is the parity of the number of components that contain the ray origin.
std::vector<uint8_t> parities(const TriangleMesh& mesh, const Components& components, const ProjectionFrame& frame,
                              const ClosedComponents& closed, double contact) {
  std::vector<Point2> points;
  points.reserve(closed.rays.size());
  for (const TestRay& ray : closed.rays) points.push_back({ray.point.x, ray.point.y});
  const PlanePoints tree(points);
  std::vector<uint8_t> result(points.size(), 0);
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    const Box3d& box = closed.boxes[components.componentOf[f]];
    const Face& face = mesh.faces[f];
    if (box.isEmpty() || !hasDistinctVertices(face)) return;
    std::array<Vec3d, 3> corners;
    std::array<Point2, 3> triangle;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = frame.toFrame(mesh.vertices[face[i]]);
      triangle[i] = {corners[i].x, corners[i].y};
    }
    tree.forEachNear(triangle, [&](uint32_t index) {
      const TestRay& ray = closed.rays[index];
      if (containsBy(contact, box, closed.boxes[ray.component]) && rayCrosses(face, corners, ray.point))
        std::atomic_ref<uint8_t>(result[index]).fetch_xor(1, std::memory_order_relaxed);
    });
  });
  return result;
}

}  // namespace

std::vector<uint8_t> findCavities(const TriangleMesh& mesh, const Components& components) {
  std::vector<uint8_t> isCavity(components.components.size(), 0);
  const auto isClosed = [](const Component& component) { return component.isClosed; };
  if (std::count_if(components.components.begin(), components.components.end(), isClosed) < 2) return isCavity;
  const ProjectionFrame frame{normalizationOf(boundsOfFiniteVertices(mesh))};
  const ClosedComponents closed = gatherClosed(mesh, components, frame);
  const double contact = frame.normalization.contactLength();
  const std::vector<uint8_t> isOdd = parities(mesh, components, frame, closed, contact);
  for (const TestRay& ray : closed.rays) isCavity[ray.component] = 1;
  for (size_t i = 0; i < isOdd.size(); ++i)
    if (!isOdd[i]) isCavity[closed.rays[i].component] = 0;
  // A body that touches the cavity in which it is may be inside of it.
  for (size_t inner = 0; inner < isCavity.size(); ++inner) {
    if (isCavity[inner] == 0 || !(components.components[inner].signedVolume > 0)) continue;
    const Box3d& box = closed.boxes[inner];
    const auto mayContain = [&](const Box3d& outer) {
      return &outer != &box && !outer.isEmpty() && containsBy(-contact, outer, box) && !containsBy(contact, outer, box);
    };
    if (std::any_of(closed.boxes.begin(), closed.boxes.end(), mayContain)) isCavity[inner] = 0;
  }
  return isCavity;
}

}  // namespace asdfvk
