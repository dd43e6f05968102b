#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "cone/cone.h"
#include "core/check.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

// Returns the median; for an even count, the mean of the middle two. Reorders `lengths`. Precondition: `lengths` is not
// empty.
double takeMedian(std::span<double> lengths) {
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  if (lengths.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(lengths.begin(), middle));
}

/// Returns the median of the absolute differences from `median`. Reorders and overwrites `lengths`.
double takeMedianDeviation(std::span<double> lengths, double median) {
  for (double& length : lengths) length = std::abs(length - median);
  return takeMedian(lengths);
}

double standardDeviation(std::span<const double> lengths) {
  const double count = static_cast<double>(lengths.size());
  const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / count;
  double sum = 0;
  for (const double length : lengths) sum += (length - mean) * (length - mean);
  return std::sqrt(sum / count);
}

}  // namespace

LengthWindow keptWindow(std::span<const double> lengths, const OutlierRule& rule) {
  ASDFVK_CHECK_OP(lengths.size(), >, size_t{0});
  ASDFVK_CHECK_OP(lengths.size(), <=, size_t{kMaxRayCount});
  std::array<double, kMaxRayCount> scratch;
  std::copy(lengths.begin(), lengths.end(), scratch.begin());
  const std::span<double> copy(scratch.data(), lengths.size());
  const double median = takeMedian(copy);
  const double spread = rule.spread == OutlierRule::Spread::StandardDeviation ? standardDeviation(lengths)
                                                                              : takeMedianDeviation(copy, median);
  return {median, rule.deviations * spread + rule.slack * median};
}

double coneValue(std::span<const double> lengths, std::span<const double> weights, const OutlierRule& rule) {
  ASDFVK_CHECK_OP(lengths.size(), ==, weights.size());
  if (lengths.empty()) return kNoValue;
  const LengthWindow window = keptWindow(lengths, rule);
  double weightedSum = 0, weightSum = 0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    if (!window.keeps(lengths[i])) continue;
    weightedSum += weights[i] * lengths[i];
    weightSum += weights[i];
  }
  return weightSum > 0 ? weightedSum / weightSum : kNoValue;
}

}  // namespace asdfvk
