#include "bvh/wide_boxes.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace asdfvk {
namespace {

constexpr int kExponentBias = 127;
constexpr uint32_t kMaxByte = 255;

// The least e with extent <= 255 * 2^e.
int exponentFor(double extent) {
  int e;
  (void)std::frexp(extent / kMaxByte, &e);
  if (std::ldexp(kMaxByte, e - 1) >= extent) --e;
  return std::max(e, 1 - kExponentBias);
}

}  // namespace

DeviceWideNode quantizeBoxes(std::span<const Box3f> children, const std::array<uint32_t, kWideChildCount>& slots) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f origin = all.min - Vec3f{kWideBoxMargin, kWideBoxMargin, kWideBoxMargin};
  DeviceWideNode node{};
  node.origin = {origin.x, origin.y, origin.z};
  const double margin = kWideBoxMargin;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double start = origin[axis];
    const int e = exponentFor(all.max[axis] + margin - start);
    node.exponents |= static_cast<uint32_t>(e + kExponentBias) << 8 * axis;
    const double perUnit = std::ldexp(1.0, -e);
    // At first each slot is empty: the lower corner of its box is above the upper corner.
    uint64_t lowers = ~uint64_t{0}, uppers = 0;
    for (size_t i = 0; i < children.size(); ++i) {
      const double lower = (children[i].min[axis] - margin - start) * perUnit;
      const double upper = (children[i].max[axis] + margin - start) * perUnit;
      const auto lowerByte = static_cast<uint64_t>(std::max(lower, 0.0));
      const auto upperByte = static_cast<uint64_t>(std::ceil(upper));
      ASDFVK_CHECK_OP(upperByte, <=, kMaxByte);
      lowers ^= (kMaxByte ^ lowerByte) << 8 * slots[i];  // Changes the byte of the slot from kMaxByte to lowerByte.
      uppers |= upperByte << 8 * slots[i];
    }
    uvec4& planes = axis == 0 ? node.x : axis == 1 ? node.y : node.z;
    planes = {{static_cast<uint32_t>(lowers), static_cast<uint32_t>(lowers >> 32), static_cast<uint32_t>(uppers),
               static_cast<uint32_t>(uppers >> 32)}};
  }
  return node;
}

}  // namespace asdfvk
