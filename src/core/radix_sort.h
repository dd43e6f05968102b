#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/unset_vector.h"

namespace asdfvk {

/// Sorts by keyOf(item), a uint32_t of at most maxKey, with a stable parallel radix sort that begins with the lowest
/// digit. Time and additional memory are linear. The result does not depend on the number of threads.
template <typename Item, typename KeyOf>
void sortByKey(UnsetVector<Item>& items, uint32_t maxKey, const KeyOf& keyOf) {
  constexpr uint32_t kMaxDigitBits = 11;
  constexpr size_t kMinBlockSize = size_t{1} << 15, kMaxBlockCount = 64;
  const auto keyBits = static_cast<uint32_t>(std::bit_width(maxKey));
  const uint32_t passCount = (keyBits + kMaxDigitBits - 1) / kMaxDigitBits;
  if (passCount == 0) return;
  const uint32_t digitBits = (keyBits + passCount - 1) / passCount;
  const size_t digitCount = size_t{1} << digitBits;
  const size_t blockSize = std::max(kMinBlockSize, (items.size() + kMaxBlockCount - 1) / kMaxBlockCount);
  const size_t blockCount = (items.size() + blockSize - 1) / blockSize;
  std::vector<uint32_t> places(blockCount * digitCount);
  UnsetVector<Item> sorted(items.size());
  for (uint32_t pass = 0; pass < passCount; ++pass) {
    const auto digitOf = [&](const Item& item) { return keyOf(item) >> pass * digitBits & (digitCount - 1); };
    const auto forEachBlock = [&](const auto& visit) {
      forEachTask(blockCount, [&](size_t block) {
        uint32_t* const own = &places[block * digitCount];
        const size_t end = std::min(items.size(), (block + 1) * blockSize);
        for (size_t i = block * blockSize; i < end; ++i) visit(own[digitOf(items[i])], items[i]);
      });
    };
    std::fill(places.begin(), places.end(), 0);
    forEachBlock([](uint32_t& count, const Item&) { ++count; });
    uint32_t place = 0;
    for (size_t digit = 0; digit < digitCount; ++digit)
      for (size_t block = 0; block < blockCount; ++block)
        place += std::exchange(places[block * digitCount + digit], place);
    forEachBlock([&](uint32_t& next, const Item& item) { sorted[next++] = item; });
    items.swap(sorted);
  }
}

}  // namespace asdfvk
