#include "generate/well_composed.h"

#include <array>
#include <bit>

namespace asdfvk {
namespace {

int8_t computeCornerToFill(uint32_t mask) {
  const auto lowest = [](uint32_t bits) { return static_cast<int8_t>(std::countr_zero(bits)); };
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    for (const uint32_t base : {0u, 1u << axis}) {
      const uint32_t side = 1u << base | 1u << (base + u) | 1u << (base + v) | 1u << (base + u + v);
      const uint32_t diagonal = 1u << base | 1u << (base + u + v);
      if ((mask & side) == diagonal) return lowest(side & ~diagonal);
      if ((mask & side) == (side & ~diagonal)) return lowest(diagonal);
    }
  }
  for (uint32_t corner = 0; corner < 4; ++corner) {
    const uint32_t diagonal = 1u << corner | 1u << (7 - corner);
    if (mask == diagonal) return static_cast<int8_t>(corner ^ 1u);
    if (mask == (0xffu & ~diagonal)) return static_cast<int8_t>(corner);
  }
  return -1;
}

std::array<int8_t, 256> computeTable() {
  std::array<int8_t, 256> table{};
  for (uint32_t mask = 0; mask < 256; ++mask) table[mask] = computeCornerToFill(mask);
  return table;
}

}  // namespace

int32_t cornerToFill(uint32_t mask) {
  static const std::array<int8_t, 256> kTable = computeTable();
  return kTable[mask & 0xffu];
}

}  // namespace asdfvk
