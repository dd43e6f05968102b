#include "trace/embree/lane_cones.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "support/shapes.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

double distanceToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d edge = b - a;
  const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
  return length(p - a - t * edge);
}

double distanceToTriangle(const Vec3d& p, const std::array<Vec3d, 3>& corners) {
  double nearest = std::numeric_limits<double>::infinity();
  const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  bool isAbove = true;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d &a = corners[k], &b = corners[(k + 1) % 3];
    nearest = std::min(nearest, distanceToSegment(p, a, b));
    isAbove = isAbove && dot(cross(normal, b - a), p - a) >= 0;
  }
  return isAbove ? std::abs(dot(p - corners[0], normal)) / length(normal) : nearest;
}

/// The distance from the point to the nearest triangle but that of its primitive, in normalised units.
double nearestOther(const TracedMesh& traced, const PrimitivePoint& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (uint32_t primitive = 0; primitive < traced.bvh.primitiveFaces.size(); ++primitive) {
    if (primitive == point.primitive) continue;
    std::array<Vec3d, 3> corners;
    for (size_t k = 0; k < 3; ++k)
      corners[k] = traced.bvh.normalization.toNormalized(
          traced.mesh.vertices[traced.mesh.faces[traced.bvh.primitiveFaces[primitive]][k]]);
    nearest = std::min(nearest, distanceToTriangle(point.point, corners));
  }
  return nearest;
}

/// Barycentres in the order of primitives; returns the number of those with a neighbour.
size_t checkAll(const TracedMesh& traced, double radius, size_t groupSize, InstructionSet instructionSet) {
  const std::vector<TrianglePlane> planes = trianglePlanes(traced.scene());
  std::vector<PrimitivePoint> points;
  for (uint32_t primitive = 0; primitive < planes.size(); ++primitive)
    points.push_back(
        {traced.bvh.normalization.toNormalized(traced.geometry.barycentres[traced.bvh.primitiveFaces[primitive]]),
         primitive});
  size_t foundCount = 0;
  for (size_t first = 0; first < points.size(); first += groupSize) {
    const auto some = std::span(points).subspan(first, std::min(groupSize, points.size() - first));
    const std::array<bool, 8> found = haveNeighboursWithin(traced.scene(), planes, some, radius, instructionSet);
    for (size_t lane = 0; lane < some.size(); ++lane) {
      const double nearest = nearestOther(traced, some[lane]);
      if (nearest <= radius) CHECK(found[lane]);
      if (nearest > 20 * radius) CHECK(!found[lane]);  // At an acute corner the moved lines intersect far away.
      foundCount += found[lane];
    }
    for (size_t lane = some.size(); lane < found.size(); ++lane) CHECK(!found[lane]);
  }
  return foundCount;
}

}  // namespace

TEST_CASE("faces nearer than the radius are found and far ones are not, as by brute force") {
  for (const InstructionSet instructionSet : {InstructionSet::Baseline, widestInstructionSet()}) {
    const TracedMesh soup(shapes::soup(300, 7));
    const size_t few = checkAll(soup, 0.005, 8, instructionSet), more = checkAll(soup, 0.02, 5, instructionSet);
    CHECK(few > 0);
    CHECK(few < more);
    CHECK(more < 300);
    const TracedMesh box(shapes::box({2, 2, 2}, 6));
    CHECK(checkAll(box, 0.01, 8, instructionSet) == 0);
    CHECK(checkAll(box, 0.2, 1, instructionSet) == box.mesh.faceCount());
  }
}

TEST_CASE("walls that touch are found on both sides, whatever their cuts") {
  const Mesh box = shapes::box({2, 2, 2}, 3);
  const TracedMesh traced(shapes::joined(box, shapes::scaledAndShifted(shapes::box({2, 2, 2}, 4), 1, {2, 0, 0})));
  const std::vector<TrianglePlane> planes = trianglePlanes(traced.scene());
  for (uint32_t primitive = 0; primitive < planes.size(); ++primitive) {
    const uint32_t face = traced.bvh.primitiveFaces[primitive];
    const Vec3d barycentre = traced.geometry.barycentres[face];
    const PrimitivePoint point{traced.bvh.normalization.toNormalized(barycentre), primitive};
    CHECK(haveNeighboursWithin(traced.scene(), planes, {&point, 1}, 0x1p-21)[0] == (std::abs(barycentre.x - 1) < 1e-9));
  }
}

TEST_CASE("nothing is near where there is no other face") {
  const TracedMesh none(Mesh{});
  const PrimitivePoint point{{0, 0, 0}, 0};
  CHECK(!haveNeighboursWithin(none.scene(), {}, {&point, 1}, 1)[0]);
  const TracedMesh alone(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}});
  CHECK(!haveNeighboursWithin(alone.scene(), trianglePlanes(alone.scene()), {&point, 1}, 1)[0]);
}
