#include "bvh/wide_boxes.h"

#include <algorithm>
#include <bit>

namespace asdfvk {
namespace {

constexpr int kExponentBias = 127;
constexpr uint32_t kMaxByte = 255;

// Exponents of normal doubles, from their bits. Library calls would dominate the time of quantizeBoxes().
int exponentOf(double positive) { return static_cast<int>(std::bit_cast<uint64_t>(positive) >> 52) - 1023; }
double powerOfTwo(int e) { return std::bit_cast<double>(static_cast<uint64_t>(e + 1023) << 52); }

// The least e with extent <= 255 * 2^e.
int exponentFor(double extent) {
  int e = exponentOf(extent / kMaxByte) + 1;
  if (kMaxByte * powerOfTwo(e - 1) >= extent) --e;
  return std::max(e, 1 - kExponentBias);
}

ASDFVK_ALWAYS_INLINE inline Double4 widened(const Vec3f& v) {
  return __builtin_convertvector(Float4{v.x, v.y, v.z, 0}, Double4);
}

// quantizeBoxes() with the axes as lanes.
ASDFVK_ALWAYS_INLINE inline DeviceWideNode quantizeInLanes(std::span<const Box3f> children,
                                                           const std::array<uint32_t, kWideChildCount>& slots) {
  using Longs = IntsOf<Double4>;
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f origin = all.min - Vec3f{kWideBoxMargin, kWideBoxMargin, kWideBoxMargin};
  DeviceWideNode node{};
  node.origin = {origin.x, origin.y, origin.z};
  const double margin = kWideBoxMargin;
  const Double4 start = widened(origin), extents = widened(all.max) + margin - start;
  Double4 perUnit{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const int e = exponentFor(extents[axis]);
    node.exponents |= static_cast<uint32_t>(e + kExponentBias) << 8 * axis;
    perUnit[axis] = powerOfTwo(-e);
  }
  // At first each slot is empty: the lower corner of its box is above the upper corner.
  Longs lowers = broadcast<Longs>(-1), uppers{}, allUpperBytes{};
  for (size_t i = 0; i < children.size(); ++i) {
    const Double4 lower = max((widened(children[i].min) - margin - start) * perUnit, Double4{});
    const Double4 upper = (widened(children[i].max) + margin - start) * perUnit;
    // The numbers are not negative, so the conversion to integers rounds down.
    const auto lowerFloor = __builtin_convertvector(lower, IntsOf<Float4>);
    const auto upperFloor = __builtin_convertvector(upper, IntsOf<Float4>);
    const Longs lowerBytes = __builtin_convertvector(lowerFloor, Longs);
    // Rounds up: a comparison gives -1 where it is true.
    const Longs upperBytes =
        __builtin_convertvector(upperFloor, Longs) - (__builtin_convertvector(upperFloor, Double4) < upper);
    allUpperBytes |= upperBytes;
    lowers ^= (kMaxByte ^ lowerBytes) << 8 * slots[i];  // Changes the byte of the slot from kMaxByte to lowerBytes.
    uppers |= upperBytes << 8 * slots[i];
  }
  ASDFVK_CHECK_OP(static_cast<uint64_t>(allUpperBytes[0] | allUpperBytes[1] | allUpperBytes[2]), <=, kMaxByte);
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<uint64_t>(lowers[axis]), high = static_cast<uint64_t>(uppers[axis]);
    uvec4& planes = axis == 0 ? node.x : axis == 1 ? node.y : node.z;
    planes = {{static_cast<uint32_t>(low), static_cast<uint32_t>(low >> 32), static_cast<uint32_t>(high),
               static_cast<uint32_t>(high >> 32)}};
  }
  return node;
}

}  // namespace

DeviceWideNode quantizeBoxes(std::span<const Box3f> children, const std::array<uint32_t, kWideChildCount>& slots,
                             InstructionSet instructionSet) {
  return dispatch<Float8>(instructionSet,
                          [&]<typename>() ASDFVK_ALWAYS_INLINE { return quantizeInLanes(children, slots); });
}

}  // namespace asdfvk
