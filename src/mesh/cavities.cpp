#include "mesh/cavities.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/box3.h"
#include "core/parallel.h"
#include "mesh/normalization.h"
#include "mesh/plane_points.h"
#include "mesh/vertex_bounds.h"

namespace asdfvk {
namespace {

// Rays run along the third axis of a frame that is not parallel to the axes, planes and diagonals along which meshes
// are often built.
struct ProjectionFrame {
  Normalization normalization;

  [[nodiscard]] Vec3d toFrame(const Vec3d& p) const {
    static constexpr Vec3d kX{0.80134262, -0.56937194, -0.18349152}, kY{0.50881031, 0.48112718, 0.71386211};
    static constexpr Vec3d kZ = cross(kX, kY);  // Only nearly orthonormal, which parity does not need.
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

ClosedComponents gatherClosed(const TriangleMesh& mesh, const Components& components, const ProjectionFrame& frame) {
  const size_t count = components.components.size();
  ClosedComponents closed{std::vector<Box3d>(count), {}};
  std::vector<std::array<uint32_t, 6>> extremes(count);  // Vertices: lowest, highest along x, y, z.
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    const uint32_t component = components.componentOf[f];
    if (!components.components[component].isClosed) continue;
    std::array<uint32_t, 6>& extreme = extremes[component];
    if (closed.boxes[component].isEmpty()) extreme.fill(mesh.faces[f][0]);
    for (uint32_t vertex : mesh.faces[f]) {
      const Vec3d& p = mesh.vertices[vertex];
      closed.boxes[component].add(p);
      for (size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] < mesh.vertices[extreme[2 * axis]][axis]) extreme[2 * axis] = vertex;
        if (p[axis] > mesh.vertices[extreme[2 * axis + 1]][axis]) extreme[2 * axis + 1] = vertex;
      }
    }
  }
  for (uint32_t component = 0; component < count; ++component) {
    if (closed.boxes[component].isEmpty()) continue;
    std::array<uint32_t, 6>& extreme = extremes[component];
    std::sort(extreme.begin(), extreme.end());
    const auto end = std::unique(extreme.begin(), extreme.end());
    for (auto vertex = extreme.begin(); vertex != end; ++vertex)
      closed.rays.push_back({component, frame.toFrame(mesh.vertices[*vertex])});
  }
  return closed;
}

bool containsStrictly(const Box3d& outer, const Box3d& inner) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (!(outer.min[axis] < inner.min[axis] && inner.max[axis] < outer.max[axis])) return false;
  return true;
}

// The side of an edge on which p lies, computed from the lower vertex to the upper one, so that the two faces of an
// edge always agree: a ray that hits an edge crosses exactly one of them, independent of rounding.
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

// For each test ray 1 when it crosses an odd number of faces of the components whose boxes contain its own one. The sum
// over components has the parity of the number of components that contain the ray origin.
std::vector<uint8_t> parities(const TriangleMesh& mesh, const Components& components, const ProjectionFrame& frame,
                              const ClosedComponents& closed) {
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
      if (containsStrictly(box, closed.boxes[ray.component]) && rayCrosses(face, corners, ray.point))
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
  const std::vector<uint8_t> isOdd = parities(mesh, components, frame, closed);
  for (const TestRay& ray : closed.rays) isCavity[ray.component] = 1;
  for (size_t i = 0; i < isOdd.size(); ++i)
    if (!isOdd[i]) isCavity[closed.rays[i].component] = 0;
  return isCavity;
}

}  // namespace asdfvk
