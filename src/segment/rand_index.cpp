#include "segment/rand_index.h"

#include <algorithm>
#include <vector>

#include "core/check.h"

namespace asdfvk {
namespace {

/// Sums of squares of the contingency table of two labellings.
struct PairWeights {
  double total = 0, squares = 0, both = 0, ofA = 0, ofB = 0;
};

template <typename Weight>
PairWeights pairWeights(std::span<const uint32_t> a, std::span<const uint32_t> b, const Weight& weight) {
  ASDFVK_CHECK_OP(a.size(), ==, b.size());
  PairWeights result;
  if (a.empty()) return result;
  const size_t countA = size_t{*std::max_element(a.begin(), a.end())} + 1,
               countB = size_t{*std::max_element(b.begin(), b.end())} + 1;
  std::vector<double> table(countA * countB, 0), ofB(countB, 0);
  for (size_t i = 0; i < a.size(); ++i) {
    const double w = weight(i);
    table[a[i] * countB + b[i]] += w;
    result.squares += w * w;
  }
  for (size_t i = 0; i < countA; ++i) {
    double ofA = 0;
    for (size_t j = 0; j < countB; ++j) {
      const double entry = table[i * countB + j];
      result.both += entry * entry;
      ofA += entry;
      ofB[j] += entry;
    }
    result.ofA += ofA * ofA;
    result.total += ofA;
  }
  for (const double sum : ofB) result.ofB += sum * sum;
  return result;
}

}  // namespace

double randIndex(std::span<const uint32_t> a, std::span<const uint32_t> b, std::span<const float> weights) {
  ASDFVK_CHECK_OP(a.size(), ==, weights.size());
  const PairWeights pairs = pairWeights(a, b, [&](size_t i) { return double{weights[i]}; });
  const double all = pairs.total * pairs.total;
  return all > 0 ? std::clamp(1 - (pairs.ofA + pairs.ofB - 2 * pairs.both) / all, 0.0, 1.0) : 1;
}

double randIndex(std::span<const uint32_t> a, std::span<const uint32_t> b) {
  const PairWeights pairs = pairWeights(a, b, [](size_t) { return 1.0; });
  const double all = pairs.total * pairs.total - pairs.squares;
  return all > 0 ? std::clamp(1 - (pairs.ofA + pairs.ofB - 2 * pairs.both) / all, 0.0, 1.0) : 1;
}

}  // namespace asdfvk
