#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace asdfvk {

/// Sorts items that are nearly always few. Counts the rank of each item without branches,
/// because processors cannot predict the branches of std::sort.
template <typename T>
void sortFew(std::span<T> items) {
  constexpr size_t kFew = 16;
  if (items.size() > kFew) return std::sort(items.begin(), items.end());
  std::array<T, kFew> sorted;
  std::array<uint8_t, kFew> ranks{};
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
