#include "trace/solid_surface.h"

#include <algorithm>

namespace asdfvk {
namespace {

/// Boxes often end where a wall ends, and then the next wall does not count. Relative to the size of the box.
constexpr double kBorder = 1e-9;

OrientedBox projectionOf(const CentredBox& box, const PlaneTriangle& plane) {
  const Vec3d& normal = plane.normal;
  const size_t axis = box.longestAxis(normal);
  Vec3d longest;
  longest[axis] = 1;
  const Vec3d along = unitVector(longest - normal[axis] * normal), across = cross(normal, along);
  return {{normal, along, across},
          box.centre - dot(box.centre - plane.corners[0], normal) * normal,
          {kFlat, (1 - kBorder) * box.reachAlong(along), (1 - kBorder) * box.reachAlong(across)}};
}

bool liesIn(const PlaneTriangle& triangle, const PlaneTriangle& plane) {
  return dot(triangle.normal, plane.normal) >= 0 &&
         std::all_of(triangle.corners.begin(), triangle.corners.end(), [&](const Vec3d& corner) {
           return std::abs(dot(corner - plane.corners[0], plane.normal)) <= kFlat;
         });
}

}  // namespace

size_t CentredBox::longestAxis(const Vec3d& direction) const {
  const auto squaredEdge = [&](size_t axis) {
    return half[axis] * half[axis] * std::max(1 - direction[axis] * direction[axis], 0.0);
  };
  size_t longest = 0;
  for (const size_t axis : {1, 2})
    if (squaredEdge(axis) > squaredEdge(longest)) longest = axis;
  return longest;
}

bool OrientedBox::meets(const BvhNode& node) const {
  const Vec3d low{node.min.x, node.min.y, node.min.z}, high{node.max.x, node.max.y, node.max.z};
  const CentredBox other{0.5 * (low + high) - centre, 0.5 * (high - low)};
  for (size_t i = 0; i < 3; ++i)
    if (std::abs(dot(other.centre, axes[i])) > half[i] + other.reachAlong(axes[i])) return false;
  return true;
}

bool OrientedBox::meets(const PlaneTriangle& triangle) const {
  const Vec3d a = triangle.corners[0] - centre, b = triangle.corners[1] - centre, c = triangle.corners[2] - centre;
  for (size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax({dot(a, axes[i]), dot(b, axes[i]), dot(c, axes[i])});
    if (low > half[i] || high < -half[i]) return false;
  }
  return true;
}

bool SolidSurface::coversPlaneBelow(const CentredBox& box, uint32_t face, uint32_t& contradiction) const {
  const PlaneTriangle plane = triangle(face);
  const OrientedBox below = projectionOf(box, plane);
  if (contradiction != kNoFace && below.meets(triangle(contradiction))) return false;
  contradiction = kNoFace;
  bool coversCentre = false;
  forEachFaceIn(below, [&](uint32_t found, const PlaneTriangle& triangle) {
    if (!liesIn(triangle, plane)) contradiction = found;
    coversCentre = coversCentre || length(nearestPoint(triangle, below.centre) - below.centre) <= 2 * kFlat;
    return contradiction == kNoFace;
  });
  // From the centre, the closed surface continues face by face, and it would meet the box where it leaves the plane.
  return coversCentre && contradiction == kNoFace;
}

bool SolidSurface::leavesEmpty(const CentredBox& box) const {
  const OrientedBox inside{{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}, box.centre, (1 - kBorder) * box.half};
  bool isEmpty = true;
  forEachFaceIn(inside, [&](uint32_t, const PlaneTriangle& found) {
    isEmpty = std::abs(dot(box.centre - found.corners[0], found.normal)) > (1 - kBorder) * box.reachAlong(found.normal);
    return isEmpty;
  });
  return isEmpty;
}

}  // namespace asdfvk
