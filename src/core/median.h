#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace asdfvk {

/// The upper of the two middle numbers for an even count, so that the result is always one of the numbers. Reorders
/// them. Precondition: at least one number, and no NaN.
[[nodiscard]] inline double upperMedian(std::vector<double>& numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

}  // namespace asdfvk
