#include "bvh/wide_slots.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/simd.h"

namespace asdfvk {
namespace {

constexpr float kNone = -1e30f;

// Eight numbers in registers. In memory, the load of a vector would wait for the store of a single number.
// A plain array and search take 2 % more CPU seconds of a whole run (1.5 million faces, Vulkan, 1 % seeds).
struct EightNumbers {
  using Ints = IntsOf<Float4>;
  static constexpr Ints kLowIndices = {0, 1, 2, 3}, kHighIndices = {4, 5, 6, 7};

  Float4 low, high;

  // The index replaces the last three bits of each number, for which no precision is required.
  [[nodiscard]] uint32_t indexOfMax() const {
    const auto tagged = [](const Float4& numbers, const Ints& indices) {
      return std::bit_cast<Float4>((std::bit_cast<Ints>(numbers) & ~7) | indices);
    };
    const Float4 greatest = max(tagged(low, kLowIndices), tagged(high, kHighIndices));
    return std::bit_cast<uint32_t>(std::max(std::max(float{greatest[0]}, float{greatest[1]}),
                                            std::max(float{greatest[2]}, float{greatest[3]}))) &
           7;
  }
  void set(uint32_t index, float number) {
    const auto at = broadcast<Ints>(static_cast<int32_t>(index));
    const auto all = broadcast<Float4>(number);
    low = kLowIndices == at ? all : low;
    high = kHighIndices == at ? all : high;
  }
};

}  // namespace

std::array<uint32_t, kWideChildCount> chooseSlots(std::span<const Box3f> children) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f centre = all.centre();
  std::array<Vec3f, kWideChildCount> offsets;
  std::array<float, kWideChildCount> offsetLengths;
  offsetLengths.fill(kNone);
  for (size_t child = 0; child < children.size(); ++child) {
    const Vec3f& offset = offsets[child] = children[child].centre() - centre;
    offsetLengths[child] = std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z);
  }
  const Float4 xSigns = {-1, 1, -1, 1}, ySigns = {-1, -1, 1, 1};
  std::array<uint32_t, kWideChildCount> slots{};
  EightNumbers distances{load<Float4>(&offsetLengths[0]), load<Float4>(&offsetLengths[4])};
  EightNumbers penalties{};  // kNone for assigned slots.
  for (size_t i = 0; i < children.size(); ++i) {
    const uint32_t child = distances.indexOfMax();
    distances.set(child, kNone);
    const auto [x, y, z] = offsets[child];
    const Float4 along = x * xSigns + y * ySigns;
    slots[child] = EightNumbers{along - z + penalties.low, along + z + penalties.high}.indexOfMax();
    penalties.set(slots[child], kNone);
  }
  return slots;
}

}  // namespace asdfvk
