#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace asdfvk {

/// Sorts a list that is nearly always short. Up to 16 items are sorted by their ranks, which are counted without
/// branches, because processors cannot predict the branches of std::sort.
template <typename T>
void sortShortList(std::span<T> items) {
  constexpr size_t kMaxShort = 16;
  if (items.size() > kMaxShort) return std::sort(items.begin(), items.end());
  std::array<T, kMaxShort> sorted;
  std::array<uint8_t, kMaxShort> ranks{};
  for (size_t i = 1; i < items.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const bool isLess = items[i] < items[j];
      ranks[j] += isLess;
      ranks[i] += !isLess;
    }
  for (size_t i = 0; i < items.size(); ++i) sorted[ranks[i]] = items[i];
  std::copy_n(sorted.begin(), items.size(), items.begin());
}

}  // namespace asdfvk
