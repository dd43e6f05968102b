#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace asdfvk {

/// The sum of term(0) .. term(count - 1), in parallel over blocks of fixed size and then over the blocks in order: the
/// same bits whatever the number of threads.
template <typename Term>
[[nodiscard]] double orderedSum(size_t count, const Term& term) {
  constexpr size_t kBlock = 8192;
  std::vector<double> sums((count + kBlock - 1) / kBlock);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, sums.size()), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t block = range.begin(); block < range.end(); ++block) {
      const size_t end = std::min(count, (block + 1) * kBlock);
      double sum = 0;
      for (size_t i = block * kBlock; i < end; ++i) sum += term(i);
      sums[block] = sum;
    }
  });
  double total = 0;
  for (double sum : sums) total += sum;
  return total;
}

/// The Euclidean norm, free of overflow and underflow; NaN if an entry is.
[[nodiscard]] inline double orderedNorm(std::span<const double> vector) {
  double largest = 0;
  for (double entry : vector) {
    if (std::isnan(entry)) return entry;
    largest = std::max(largest, std::abs(entry));
  }
  if (largest == 0 || std::isinf(largest)) return largest;
  return largest * std::sqrt(orderedSum(vector.size(), [&](size_t i) {
           const double scaled = vector[i] / largest;
           return scaled * scaled;
         }));
}

}  // namespace asdfvk
