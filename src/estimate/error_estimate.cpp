#include "estimate/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/percentiles.h"
#include "core/vec3.h"
#include "core/weighted_sample.h"

namespace asdfvk {
namespace {

constexpr size_t kWorstFaceCount = 5;

// The held-out faces are seeds of the result, so that its error is lower. The error is assumed to be proportional to
// (number of seeds)^-kGainExponent. The true exponents differ between meshes (bench/experiments.md).
constexpr double kGainExponent = 0.12, kGainExponentWithoutPrediction = 0.5;

/// Range of the traced values. The range of the function is wider if its extremes were not traced.
double tracedRange(const Seeds& seeds) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const double value : seeds.values)
    if (!std::isnan(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return high > low ? high - low : 0;
}

/// The 99th minus the 1st percentile of the values; NaN without a finite value.
double robustRange(std::span<const double> values) {
  constexpr std::array<double, 2> kShares{0.01, 0.99};
  const std::vector<double> ends = percentilesOf(values, kShares);
  return ends.empty() ? kNoValue : ends[1] - ends[0];
}

/// The power of two at or below the range. Errors are squared in this unit: at any scale of the mesh the squares
/// neither overflow nor underflow, and the division is exact.
double unitOf(double range) { return std::scalbn(1.0, std::ilogb(range)); }

double indicatorOf(std::span<const double> indicator, size_t node) { return indicator.empty() ? 1 : indicator[node]; }

/// Factor by which the error of a face falls when the held-out seeds become seeds of the result.
double gainBySeeds(const EstimateInput& input) {
  const auto heldOutCount = static_cast<double>(input.seeds.heldOutWeights.size()),
             seedCount = static_cast<double>(input.seeds.size());
  return power(1 - heldOutCount / seedCount, input.predicts ? kGainExponent : kGainExponentWithoutPrediction);
}

struct Measurement {
  uint32_t node = 0;
  double error = 0, indicator = 0, weight = 0, value = 0;
};

/// Errors at the held-out seeds with a value.
std::vector<Measurement> measureErrors(const EstimateInput& input) {
  const Seeds& seeds = input.seeds;
  std::vector<Measurement> measured;
  for (size_t seed = 0, i = 0; seed < seeds.size(); ++seed) {
    if (!seeds.isHeldOut(seed)) continue;
    const uint32_t node = seeds.nodes[seed];
    const Measurement measurement{node, std::abs(input.withoutHeldOut[i] - seeds.values[seed]),
                                  indicatorOf(input.indicator, node), seeds.heldOutWeights[i], seeds.values[seed]};
    ++i;
    if (!std::isnan(measurement.error) && !std::isnan(input.result[node])) measured.push_back(measurement);
  }
  return measured;
}

std::vector<WorstFace> worstOf(const TriangleMesh& mesh, const FaceDomain& domain, std::vector<Measurement> measured,
                               double range) {
  const size_t count = std::min(kWorstFaceCount, measured.size());
  std::partial_sort(measured.begin(), measured.begin() + static_cast<std::ptrdiff_t>(count), measured.end(),
                    [](const Measurement& a, const Measurement& b) {
                      return a.error != b.error ? a.error > b.error : a.node < b.node;
                    });
  std::vector<WorstFace> worst;
  for (size_t i = 0; i < count; ++i)
    worst.push_back({mesh.inputFaceOf(domain.faceOf(measured[i].node)), measured[i].error / range});
  return worst;
}

/// Sums over faces with a value.
struct ExpectedSums {
  double indicator = 0;  // Sum over interpolated faces.
  uint64_t count = 0, interpolatedCount = 0;

  ExpectedSums operator+(const ExpectedSums& other) const {
    return {indicator + other.indicator, count + other.count, interpolatedCount + other.interpolatedCount};
  }
};

ExpectedSums expectedSums(const FaceDomain& domain, const EstimateInput& input) {
  std::vector<uint8_t> isKnown(input.result.size(), 0);
  forEachInParallel(input.seeds.size(), [&](size_t seed) {
    if (!std::isnan(input.seeds.values[seed])) isKnown[input.seeds.nodes[seed]] = 1;
  });
  const auto sumIn = [&](size_t begin, size_t end) {
    ExpectedSums sums;
    for (auto node = static_cast<uint32_t>(begin); node < end; ++node) {
      if (std::isnan(input.result[node])) continue;
      const uint32_t count = domain.representedCountOf(node), interpolatedCount = count - isKnown[node];
      sums.indicator += interpolatedCount * indicatorOf(input.indicator, node);
      sums.count += count;
      sums.interpolatedCount += interpolatedCount;
    }
    return sums;
  };
  return foldInParallel<ExpectedSums>(input.result.size(), sumIn, std::plus<>());
}

/// Sum of the differences between the result and the traced values.
double sumOfKnownErrors(const EstimateInput& input, double unit) {
  double sum = 0;
  for (size_t seed = 0; seed < input.seeds.size(); ++seed)
    if (const double error = std::abs(input.result[input.seeds.nodes[seed]] - input.seeds.values[seed]); error > 0)
      sum += error / unit;
  return sum;
}

/// An error of 0 gives 0, also for the value 0.
double relativeError(double error, double value) { return error == 0 ? 0 : error / std::abs(value); }

/// Estimates quantiles of the relative errors. The errors of seeds are known. A held-out face represents interpolated
/// faces; their number is proportional to its sampling weight. interpolatedCount: number of interpolated faces with a
/// value.
void estimateRelativeErrors(const EstimateInput& input, const std::vector<Measurement>& measured, double gain,
                            uint64_t interpolatedCount, ErrorEstimate& estimate) {
  WeightedSample errors;
  uint64_t count = interpolatedCount, exactCount = 0;
  for (size_t seed = 0; seed < input.seeds.size(); ++seed) {
    const double traced = input.seeds.values[seed], error = std::abs(input.result[input.seeds.nodes[seed]] - traced);
    if (std::isnan(error)) continue;
    if (error > 0)
      errors.add(relativeError(error, traced), 1);
    else
      ++exactCount;
    ++count;
  }
  if (exactCount > 0) errors.add(0, static_cast<double>(exactCount));
  double weightSum = 0, squareSum = 0;
  for (const Measurement& m : measured) {
    weightSum += m.weight;
    squareSum += m.weight * m.weight;
  }
  const double facesPerWeight = static_cast<double>(interpolatedCount) / weightSum;
  for (const Measurement& m : measured)
    if (m.weight > 0) errors.add(gain * relativeError(m.error, m.value), m.weight * facesPerWeight);
  errors.sort();
  estimate.relativeMedian = errors.quantile(0.5);
  estimate.relativePercentile90 = errors.quantile(0.9);
  // Woodruff 1952: the standard error of the share of faces below the median, mapped through the quantiles.
  const double interpolatedShare = static_cast<double>(interpolatedCount) / static_cast<double>(count);
  // Quantile among the interpolated faces.
  const double medianShare = std::clamp(1 - 0.5 / interpolatedShare, 0.0, 1.0);
  const double deviation = interpolatedShare * std::sqrt(medianShare * (1 - medianShare) * squareSum) / weightSum;
  const double spread = (errors.quantile(std::min(1.0, 0.5 + deviation)) - errors.quantile(0.5 - deviation)) / 2;
  estimate.relativeMedianStandardError = lengthInAnyUnit(Vec3d{spread, (1 - gain) / gain * estimate.relativeMedian, 0});
}

}  // namespace

EstimatedErrors estimateErrors(const TriangleMesh& mesh, const FaceDomain& domain, const EstimateInput& input) {
  EstimatedErrors errors;
  const double range = tracedRange(input.seeds);
  const std::vector<Measurement> measured = measureErrors(input);
  // Faces with inclusion probability 1 represent only themselves.
  const auto representativeCount =
      std::count_if(measured.begin(), measured.end(), [](const Measurement& m) { return m.weight > 0; });
  if (representativeCount < 2 || !(range > 0)) return errors;

  const double unit = unitOf(range);
  double errorSum = 0, indicatorSum = 0;
  for (const Measurement& m : measured) {
    errorSum += m.weight * (m.error / unit);
    indicatorSum += m.weight * m.indicator;
  }
  const double ratio = errorSum / indicatorSum;
  double squareSum = 0;
  for (const Measurement& m : measured) {
    const double difference = m.weight * (m.error / unit - ratio * m.indicator);
    squareSum += difference * difference;
  }
  const auto sampleSize = static_cast<double>(representativeCount);
  const double ratioDeviation = std::sqrt(squareSum * sampleSize / (sampleSize - 1)) / indicatorSum;
  const double gain = gainBySeeds(input), gainDeviation = 1 - gain;

  const ExpectedSums sums = expectedSums(domain, input);
  const double scale = 1 / (static_cast<double>(sums.count) * (range / unit));
  const double sum = gain * ratio * sums.indicator + sumOfKnownErrors(input, unit);
  errors.perIndicator = gain * ratio * unit;
  errors.average = sum / static_cast<double>(sums.count) * unit;
  estimateRelativeErrors(input, measured, gain, sums.interpolatedCount, errors.estimate);
  errors.estimate.average = sum * scale;
  errors.estimate.standardError =
      gain * lengthInAnyUnit(Vec3d{ratioDeviation, gainDeviation * ratio, 0}) * sums.indicator * scale;
  errors.estimate.heldOutCount = measured.size();
  errors.estimate.worstFaces = worstOf(mesh, domain, measured, range);
  return errors;
}

UnsetVector<double> expectedErrors(EstimatedErrors& errors, const Seeds& seeds, std::span<const double> values,
                                   std::span<const double> indicator) {
  UnsetVector<double> expected(values.size());
  forEachInParallel(values.size(), [&](size_t face) {
    expected[face] = std::isnan(values[face]) ? 0 : errors.perIndicator * indicatorOf(indicator, face);
  });
  forEachInParallel(seeds.size(), [&](size_t seed) {
    const uint32_t face = seeds.nodes[seed];
    if (const double error = std::abs(values[face] - seeds.values[seed]); !std::isnan(error)) expected[face] = error;
  });
  errors.estimate.robustAverage = errors.average / robustRange(values);
  return expected;
}

}  // namespace asdfvk
