#include "cone/cone_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/check.h"
#include "core/simd.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

// Up to this count, medianByCounting() is faster than std::nth_element().
constexpr size_t kMaxCountedLengths = 64;

/// The same result as takeMedian(), without unpredictable branches. For each length, the function counts the shorter
/// lengths. In sorted order, length k (from 0) is the greatest length whose count is at most k. Precondition: 1 to
/// kMaxCountedLengths lengths.
ASDFVK_ALWAYS_INLINE inline double medianByCounting(std::span<const double> lengths) {
  using Counts = IntsOf<Double4>;
  constexpr size_t kLanes = kLaneCount<Double4>, kVectors = 2;  // Two sums that do not wait for each other.
  std::array<double, kMaxCountedLengths + kVectors * kLanes> padded;
  std::copy(lengths.begin(), lengths.end(), padded.begin());
  std::fill_n(padded.begin() + static_cast<std::ptrdiff_t>(lengths.size()), kVectors * kLanes,
              std::numeric_limits<double>::infinity());
  const auto middle = static_cast<int64_t>(lengths.size() / 2);
  const Double4 none = broadcast<Double4>(-std::numeric_limits<double>::infinity());
  Double4 upper = none, lower = none;  // The middle two.
  for (size_t first = 0; first < lengths.size(); first += kVectors * kLanes) {
    const Double4 own[kVectors] = {load<Double4>(&padded[first]), load<Double4>(&padded[first + kLanes])};
    Counts less[kVectors] = {};
    for (const double length : lengths) {
      const Double4 other = broadcast<Double4>(length);
      less[0] -= other < own[0];
      less[1] -= other < own[1];
    }
    for (size_t k = 0; k < kVectors; ++k) {
      upper = max(upper, less[k] <= middle ? own[k] : none);
      lower = max(lower, less[k] < middle ? own[k] : none);
    }
  }
  const auto greatest = [](const Double4& v)
                            ASDFVK_ALWAYS_INLINE { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); };
  return lengths.size() % 2 == 1 ? greatest(upper) : 0.5 * (greatest(upper) + greatest(lower));
}

// Returns the median; for an even count, the mean of the middle two. May reorder `lengths`. Precondition: `lengths` is
// not empty. Without AVX2, counting is slower.
double takeMedian(std::span<double> lengths) {
  const InstructionSet instructionSet = widestInstructionSet();
  if (instructionSet != InstructionSet::Baseline && lengths.size() <= kMaxCountedLengths)
    return dispatch<Float8>(instructionSet, [&]<typename>() ASDFVK_ALWAYS_INLINE { return medianByCounting(lengths); });
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  if (lengths.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(lengths.begin(), middle));
}

/// Returns the median of the absolute differences from `median`. Overwrites `lengths`.
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
