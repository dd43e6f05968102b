#include "bvh/wide_node.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/check.h"
#include "core/simd.h"

namespace asdfvk {
namespace {

constexpr int kExponentBias = 127;
constexpr uint32_t kLargestByte = 255;

// Of a normal double and to one: library calls would take longer than all else here.
int exponentOf(double positive) { return static_cast<int>(std::bit_cast<uint64_t>(positive) >> 52) - 1023; }
double powerOfTwo(int e) { return std::bit_cast<double>(static_cast<uint64_t>(e + 1023) << 52); }

// The least e with extent <= 255 * 2^e.
int exponentFor(double extent) {
  int e = exponentOf(extent / kLargestByte) + 1;
  if (kLargestByte * powerOfTwo(e - 1) >= extent) --e;
  return std::max(e, 1 - kExponentBias);
}

constexpr float kNone = -1e30f;

// Of eight, where the last three bits of a number do not matter: the index travels in them.
uint32_t indexOfMax(const Float4& low, const Float4& high) {
  using Ints = IntsOf<Float4>;
  const Ints indices = {0, 1, 2, 3};
  const auto tagged = [](const Float4& numbers, const Ints& tags) {
    return std::bit_cast<Float4>((std::bit_cast<Ints>(numbers) & ~7) | tags);
  };
  const Float4 greatest = max(tagged(low, indices), tagged(high, indices + 4));
  return std::bit_cast<uint32_t>(std::max(std::max(float{greatest[0]}, float{greatest[1]}),
                                          std::max(float{greatest[2]}, float{greatest[3]}))) &
         7;
}

uint32_t floorOf(double notNegative) { return static_cast<uint32_t>(notNegative); }
uint32_t ceilOf(double notNegative) {
  const uint32_t below = floorOf(notNegative);
  return below + (below < notNegative ? 1 : 0);
}

}  // namespace

std::array<uint32_t, kWideChildCount> chooseSlots(std::span<const Box3f> children) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f centre = all.centre();
  std::array<Vec3f, kWideChildCount> offsets;
  std::array<float, kWideChildCount> distances;
  distances.fill(kNone);
  for (size_t child = 0; child < children.size(); ++child) {
    const Vec3f& offset = offsets[child] = children[child].centre() - centre;
    distances[child] = std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z);
  }
  const Float4 xSigns = {-1, 1, -1, 1}, ySigns = {-1, -1, 1, 1};
  std::array<uint32_t, kWideChildCount> slots{};
  std::array<float, kWideChildCount> penalties{};  // Of slots that are taken.
  for (size_t i = 0; i < children.size(); ++i) {
    const uint32_t child = indexOfMax(load<Float4>(&distances[0]), load<Float4>(&distances[4]));
    distances[child] = kNone;
    const auto [x, y, z] = offsets[child];
    const Float4 along = x * xSigns + y * ySigns;
    slots[child] = indexOfMax(along - z + load<Float4>(&penalties[0]), along + z + load<Float4>(&penalties[4]));
    penalties[slots[child]] = kNone;
  }
  return slots;
}

DeviceWideNode quantizeBoxes(std::span<const Box3f> children, const std::array<uint32_t, kWideChildCount>& slots) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f origin = all.min - Vec3f{kWideBoxMargin, kWideBoxMargin, kWideBoxMargin};
  DeviceWideNode node{};
  node.origin = {origin.x, origin.y, origin.z};
  uint64_t emptySlots = ~uint64_t{0};
  for (size_t i = 0; i < children.size(); ++i) emptySlots &= ~(uint64_t{kLargestByte} << 8 * slots[i]);
  for (size_t axis = 0; axis < 3; ++axis) {
    const double start = origin[axis], margin = kWideBoxMargin;
    const int e = exponentFor(static_cast<double>(all.max[axis]) + margin - start);
    node.exponents |= static_cast<uint32_t>(e + kExponentBias) << 8 * axis;
    const double perUnit = powerOfTwo(-e);
    uint64_t lowers = emptySlots, uppers = 0;  // an empty slot's box has its lower corner above its upper one
    for (size_t i = 0; i < children.size(); ++i) {
      const double lower = static_cast<double>(children[i].min[axis]) - margin - start;
      const double upper = static_cast<double>(children[i].max[axis]) + margin - start;
      const uint32_t upperByte = ceilOf(upper * perUnit);
      ASDFVK_CHECK_OP(upperByte, <=, kLargestByte);
      lowers |= uint64_t{floorOf(std::max(0.0, lower * perUnit))} << 8 * slots[i];
      uppers |= uint64_t{upperByte} << 8 * slots[i];
    }
    uvec4& planes = axis == 0 ? node.x : axis == 1 ? node.y : node.z;
    planes = {{static_cast<uint32_t>(lowers), static_cast<uint32_t>(lowers >> 32), static_cast<uint32_t>(uppers),
               static_cast<uint32_t>(uppers >> 32)}};
  }
  return node;
}

}  // namespace asdfvk
