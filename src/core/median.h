#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace asdfvk {

/// The median; for an even count the upper of the middle two. Reorders the numbers. Preconditions: at least one number,
/// no NaN.
[[nodiscard]] inline double upperMedian(std::vector<double>& numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// The number at index round(share * (count - 1)) in ascending order. share: 0 to 1. Reorders the numbers.
/// Precondition: at least one number, and no NaN.
[[nodiscard]] inline double percentileOf(std::vector<double>& numbers, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(numbers.size() - 1)));
  std::nth_element(numbers.begin(), numbers.begin() + rank, numbers.end());
  return numbers[static_cast<size_t>(rank)];
}

}  // namespace asdfvk
