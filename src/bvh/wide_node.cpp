#include "bvh/wide_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace asdfvk {
namespace {

constexpr int kExponentBias = 127;
constexpr double kLargestByte = 255;

// The least e with extent <= 255 * 2^e.
int exponentFor(double extent) {
  int e = 0;
  (void)std::frexp(extent / kLargestByte, &e);  // below 2^e, at or above 2^(e - 1)
  if (std::ldexp(kLargestByte, e - 1) >= extent) --e;
  return std::max(e, 1 - kExponentBias);
}

void setByte(uint32_t (&words)[4], uint32_t index, double value) {
  ASDFVK_CHECK(value >= 0 && value <= kLargestByte);
  words[index / 4] |= static_cast<uint32_t>(value) << 8 * (index % 4);
}

}  // namespace

std::array<uint32_t, kWideChildCount> chooseSlots(std::span<const Box3f> children) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f centre = all.centre();
  std::array<uint32_t, kWideChildCount> slots{};
  std::array<bool, kWideChildCount> isPlaced{}, isTaken{};
  for (size_t round = 0; round < children.size(); ++round) {
    float best = -std::numeric_limits<float>::infinity();
    size_t bestChild = 0, bestSlot = 0;
    for (size_t child = 0; child < children.size(); ++child) {
      if (isPlaced[child]) continue;
      const Vec3f offset = children[child].centre() - centre;
      for (size_t slot = 0; slot < kWideChildCount; ++slot) {
        const float along =
            (slot & 1 ? offset.x : -offset.x) + (slot & 2 ? offset.y : -offset.y) + (slot & 4 ? offset.z : -offset.z);
        if (isTaken[slot] || along <= best) continue;
        best = along;
        bestChild = child;
        bestSlot = slot;
      }
    }
    slots[bestChild] = static_cast<uint32_t>(bestSlot);
    isPlaced[bestChild] = isTaken[bestSlot] = true;
  }
  return slots;
}

DeviceWideNode quantizeBoxes(std::span<const Box3f> children, const std::array<uint32_t, kWideChildCount>& slots) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f origin = all.min - Vec3f{kWideBoxMargin, kWideBoxMargin, kWideBoxMargin};
  DeviceWideNode node{};
  node.origin = {origin.x, origin.y, origin.z};
  for (size_t axis = 0; axis < 3; ++axis) {
    uint32_t(&words)[4] = axis == 0 ? node.x.words : axis == 1 ? node.y.words : node.z.words;
    const double start = origin[axis], margin = kWideBoxMargin;
    const int e = exponentFor(static_cast<double>(all.max[axis]) + margin - start);
    node.exponents |= static_cast<uint32_t>(e + kExponentBias) << 8 * axis;
    const double perUnit = std::ldexp(1.0, -e);
    words[0] = words[1] = 0xffffffffu;  // an empty slot's box has its lower corner above its upper one
    for (size_t i = 0; i < children.size(); ++i) words[slots[i] / 4] &= ~(0xffu << 8 * (slots[i] % 4));
    for (size_t i = 0; i < children.size(); ++i) {
      const double lower = static_cast<double>(children[i].min[axis]) - margin - start;
      const double upper = static_cast<double>(children[i].max[axis]) + margin - start;
      setByte(words, slots[i], std::max(0.0, std::floor(lower * perUnit)));
      setByte(words, kWideChildCount + slots[i], std::ceil(upper * perUnit));
    }
  }
  return node;
}

}  // namespace asdfvk
