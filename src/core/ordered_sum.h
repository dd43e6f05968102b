#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "core/parallel.h"

namespace asdfvk {

/// The sum of term(0) .. term(count - 1). Blocks of fixed size are summed in parallel, and then the sums of the blocks
/// are added in order. Therefore the result has the same bits on any number of threads.
template <typename Term>
[[nodiscard]] double orderedSum(size_t count, const Term& term) {
  constexpr size_t kBlockSize = 8192;
  const auto sumOf = [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t i = begin; i < end; ++i) sum += term(i);
    return sum;
  };
  return foldInParallel<double, kBlockSize>(count, sumOf, std::plus<>());
}

inline constexpr double kMinPlainSquare = 1e-200, kMaxPlainSquare = 1e300;

/// The Euclidean norm of entry(0) .. entry(count - 1), without overflow and underflow; NaN if an entry is NaN.
template <typename Entry>
[[nodiscard]] double orderedNorm(size_t count, const Entry& entry) {
  const double squared = orderedSum(count, [&](size_t i) { return entry(i) * entry(i); });
  // If the sum is between these bounds, no square has overflowed, and squares that underflowed are negligible.
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
