#pragma once

#include <span>
#include <vector>

namespace asdfvk {

/// For each share (0 to 1), the finite number at index round(share * (count - 1)) in ascending order, where `count` is
/// the number of finite numbers. Share 0.5 gives the median, of an even count the upper of the middle two. Empty
/// without a finite number. Takes three parallel passes over the numbers, and then selects among the few numbers near
/// each result. In the worst case, for example if almost all numbers are equal, these are all numbers.
[[nodiscard]] std::vector<double> percentilesOf(std::span<const double> numbers, std::span<const double> shares);

}  // namespace asdfvk
