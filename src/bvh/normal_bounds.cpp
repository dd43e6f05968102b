#include "bvh/normal_bounds.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {
namespace {

constexpr uint32_t kUpperShift = kNormalBoundsBits;
constexpr double kSteps = kNormalBoundsMask / 2.0;  // From -1 to 1 there are 2 kSteps.

uint32_t clampToMask(double value) {
  return static_cast<uint32_t>(std::clamp(value, 0.0, static_cast<double>(kNormalBoundsMask)));
}

}  // namespace

void NormalBounds::add(const Vec3d& normal) {
  NormalBounds single{0};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double position = (normal[axis] + 1) * kSteps;
    const auto shift = static_cast<uint32_t>(2 * kNormalBoundsBits * axis);
    single.bits |= clampToMask(std::floor(position)) << shift | clampToMask(std::ceil(position))
                                                                    << (shift + kUpperShift);
  }
  add(single);
}

void NormalBounds::add(const NormalBounds& other) {
  uint32_t result = 0;
  for (uint32_t shift = 0; shift < 6 * kNormalBoundsBits; shift += 2 * kNormalBoundsBits) {
    const auto field = [&](uint32_t word, uint32_t at) { return word >> at & kNormalBoundsMask; };
    result |= std::min(field(bits, shift), field(other.bits, shift)) << shift |
              std::max(field(bits, shift + kUpperShift), field(other.bits, shift + kUpperShift))
                  << (shift + kUpperShift);
  }
  bits = result;
}

NormalBoundsTest::NormalBoundsTest(const Vec3d& normal, double cosine)
    : factors_(normal / kSteps), limit_(cosine + normal.x + normal.y + normal.z + 1e-12) {
  for (size_t axis = 0; axis < 3; ++axis)
    shifts_[axis] = static_cast<uint32_t>(2 * kNormalBoundsBits * axis) + (normal[axis] < 0 ? kUpperShift : 0);
}

std::vector<NormalBounds> normalBoundsOf(const Bvh& bvh, const FaceGeometry& geometry) {
  std::vector<NormalBounds> bounds(bvh.nodes.size());
  // Backwards: children follow their parent.
  for (size_t i = bounds.size(); i-- > 0;) {
    const BvhNode& node = bvh.nodes[i];
    if (!node.isLeaf()) {
      bounds[i].add(bounds[node.first]);
      bounds[i].add(bounds[node.first + 1]);
    }
    for (uint32_t primitive = node.first; primitive < node.first + node.triangleCount; ++primitive)
      bounds[i].add(geometry.normals[bvh.primitiveFaces[primitive]]);
  }
  return bounds;
}

}  // namespace asdfvk
