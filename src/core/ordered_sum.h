#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/parallel.h"

namespace asdfvk {

/// The sum of term(0) .. term(count - 1), in parallel over blocks of fixed size and then over the blocks in order: the
/// same bits on any number of threads.
template <typename Term>
[[nodiscard]] double orderedSum(size_t count, const Term& term) {
  constexpr size_t kBlock = 8192;
  std::vector<double> sums((count + kBlock - 1) / kBlock);
  forEachTask(sums.size(), [&](size_t block) {
    const size_t end = std::min(count, (block + 1) * kBlock);
    double sum = 0;
    for (size_t i = block * kBlock; i < end; ++i) sum += term(i);
    sums[block] = sum;
  });
  double total = 0;
  for (double sum : sums) total += sum;
  return total;
}

inline constexpr double kMinPlainSquare = 1e-200, kMaxPlainSquare = 1e300;

/// The Euclidean norm of entry(0) .. entry(count - 1), without overflow and underflow; NaN if an entry is NaN.
template <typename Entry>
[[nodiscard]] double orderedNorm(size_t count, const Entry& entry) {
  const double squared = orderedSum(count, [&](size_t i) { return entry(i) * entry(i); });
  // Between these bounds no relevant square has left the range of double.
  if (squared > kMinPlainSquare && squared < kMaxPlainSquare) return std::sqrt(squared);
  double largest = 0;
  for (size_t i = 0; i < count; ++i) {
    const double magnitude = std::abs(entry(i));
    if (std::isnan(magnitude)) return magnitude;
    largest = std::max(largest, magnitude);
  }
  if (largest == 0 || std::isinf(largest)) return largest;
  return largest * std::sqrt(orderedSum(count, [&](size_t i) {
           const double scaled = entry(i) / largest;
           return scaled * scaled;
         }));
}

}  // namespace asdfvk
