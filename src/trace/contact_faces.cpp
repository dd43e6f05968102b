#include "trace/contact_faces.h"

#include <algorithm>
#include <cmath>

#include "bvh/leaf_faces.h"
#include "core/box3.h"

namespace asdfvk {
namespace {

/// Between the normals of faces in contact, at most: planes farther from each other's meet in a line only.
constexpr double kOppositeCosine = -0.9;

bool isInPlane(const PlaneTriangle& triangle, const PlaneTriangle& other, double distance) {
  return std::all_of(triangle.corners.begin(), triangle.corners.end(), [&](const Vec3d& corner) {
    return std::abs(dot(corner - other.corners[0], other.normal)) <= distance;
  });
}

}  // namespace

ContactFaces::ContactFaces(const TraceScene& scene, double contactDistance)
    : scene_(scene), contactDistance_(contactDistance), states_(scene.bvh.primitiveFaces.size()) {}

bool ContactFaces::contain(uint32_t primitive) {
  std::atomic_ref state(states_[primitive]);
  if (state.load(std::memory_order_relaxed) == Unknown)
    state.store(isInContact(primitive) ? InContact : Apart, std::memory_order_relaxed);
  return state.load(std::memory_order_relaxed) == InContact;
}

bool ContactFaces::isInContact(uint32_t primitive) const {
  const PlaneTriangle triangle = triangleOf(scene_, scene_.bvh.primitiveFaces[primitive]);
  Box3d box;
  for (const Vec3d& corner : triangle.corners) box.add(corner);
  const auto reaches = [&](const BvhNode& node) { return overlaps(node, box, contactDistance_); };
  bool isFound = false;
  forEachLeafFace(scene_.bvh, reaches, [&](uint32_t face) {
    if (dot(scene_.geometry.normals[face], triangle.normal) > kOppositeCosine) return true;
    const PlaneTriangle other = triangleOf(scene_, face);
    isFound = isInPlane(triangle, other, 2 * contactDistance_) || isInPlane(other, triangle, 2 * contactDistance_);
    return !isFound;
  });
  return isFound;
}

}  // namespace asdfvk
