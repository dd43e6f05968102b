#pragma once

#include <span>
#include <vector>

namespace asdfvk {

/// Percentiles of the finite numbers. For each share (0 to 1), returns the number at index round(share * (n - 1)) of
/// the n finite numbers in ascending order. For an even n, the share 0.5 gives the upper of the two middle numbers. The
/// result is empty if no number is finite. The function makes three parallel passes over the numbers, and then selects
/// among the numbers near the results. These are few, unless many numbers are almost equal.
[[nodiscard]] std::vector<double> percentilesOf(std::span<const double> numbers, std::span<const double> shares);

}  // namespace asdfvk
