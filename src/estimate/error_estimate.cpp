#include "estimate/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/parallel.h"
#include "core/percentiles.h"
#include "core/weighted_sample.h"

namespace asdfvk {
namespace {

constexpr size_t kWorstFaceCount = 5;

// The held-out faces are seeds of the result, so that its error is lower. The error is assumed to be proportional to
// (number of seeds)^-kGainExponent. The true exponents differ between meshes (bench/experiments.md).
constexpr double kGainExponent = 0.12, kGainExponentWithoutPrediction = 0.5;

/// Range of the traced values. The range of the function is wider if its extremes were not traced.
double tracedRange(const EstimateInput& input) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const uint32_t face : input.traced.faces)
    if (const double value = input.traced.values[face]; !std::isnan(value)) {
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

double indicatorOf(const EstimateInput& input, size_t face) {
  return input.indicator.empty() ? 1 : input.indicator[face];
}

/// Factor by which the error of a face falls when the held-out faces become seeds.
double gainBySeeds(const EstimateInput& input) {
  const auto heldOutCount = static_cast<double>(input.heldOut.faces.size()),
             seedCount = static_cast<double>(input.traced.faces.size());
  return std::pow(1 - heldOutCount / seedCount, input.predicts ? kGainExponent : kGainExponentWithoutPrediction);
}

struct Measurement {
  uint32_t face = 0;
  double error = 0, indicator = 0, weight = 0, value = 0;
};

/// Errors at the held-out faces with a value.
std::vector<Measurement> measureErrors(const EstimateInput& input) {
  std::vector<Measurement> measured;
  for (size_t i = 0; i < input.heldOut.faces.size(); ++i) {
    const uint32_t face = input.heldOut.faces[i];
    const Measurement measurement{face, std::abs(input.withoutHeldOut[i] - input.traced.values[face]),
                                  indicatorOf(input, face), input.heldOut.weights[i], input.traced.values[face]};
    if (!std::isnan(measurement.error) && !std::isnan(input.result[face])) measured.push_back(measurement);
  }
  return measured;
}

std::vector<WorstFace> worstOf(const TriangleMesh& mesh, std::vector<Measurement> measured, double range) {
  const size_t count = std::min(kWorstFaceCount, measured.size());
  std::partial_sort(measured.begin(), measured.begin() + static_cast<std::ptrdiff_t>(count), measured.end(),
                    [](const Measurement& a, const Measurement& b) {
                      return a.error != b.error ? a.error > b.error : a.face < b.face;
                    });
  std::vector<WorstFace> worst;
  for (size_t i = 0; i < count; ++i) worst.push_back({mesh.inputFaceOf(measured[i].face), measured[i].error / range});
  return worst;
}

/// Sums over faces with a value.
struct ExpectedSums {
  double error = 0, interpolatedIndicator = 0;  // Unit of the error: unitOf().
  size_t count = 0, interpolatedCount = 0;

  ExpectedSums operator+(const ExpectedSums& other) const {
    return {error + other.error, interpolatedIndicator + other.interpolatedIndicator, count + other.count,
            interpolatedCount + other.interpolatedCount};
  }
};

/// An error of 0 gives 0, also for the value 0.
double relativeError(double error, double value) { return error == 0 ? 0 : error / std::abs(value); }

/// Estimates quantiles of the relative errors. The errors of seeds are known. A held-out face represents interpolated
/// faces; their number is proportional to its sampling weight. interpolatedCount: number of interpolated faces with a
/// value.
void estimateRelativeErrors(const EstimateInput& input, const std::vector<Measurement>& measured, double gain,
                            size_t interpolatedCount, ErrorEstimate& estimate) {
  WeightedSample errors;
  size_t count = interpolatedCount, exactCount = 0;
  for (const uint32_t face : input.traced.faces) {
    const double traced = input.traced.values[face], error = std::abs(input.result[face] - traced);
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
  estimate.relativeMedianStandardError = std::hypot(spread, (1 - gain) / gain * estimate.relativeMedian);
}

}  // namespace

EstimatedErrors estimateErrors(const TriangleMesh& mesh, const EstimateInput& input) {
  EstimatedErrors result;
  const double range = tracedRange(input);
  const std::vector<Measurement> measured = measureErrors(input);
  // Faces with inclusion probability 1 represent only themselves.
  const auto representativeCount =
      std::count_if(measured.begin(), measured.end(), [](const Measurement& m) { return m.weight > 0; });
  if (representativeCount < 2 || !(range > 0)) {
    result.expected = filledInParallel(input.result.size(), 0.0);
    return result;
  }

  const double unit = unitOf(range);
  double errorSum = 0, indicatorSum = 0;
  for (const Measurement& m : measured) {
    errorSum += m.weight * (m.error / unit);
    indicatorSum += m.weight * m.indicator;
  }
  const double ratio = errorSum / indicatorSum;
  double squareSum = 0;
  for (const Measurement& m : measured) squareSum += std::pow(m.weight * (m.error / unit - ratio * m.indicator), 2);
  const auto sampleSize = static_cast<double>(representativeCount);
  const double ratioDeviation = std::sqrt(squareSum * sampleSize / (sampleSize - 1)) / indicatorSum;
  const double gain = gainBySeeds(input), gainDeviation = 1 - gain;

  result.expected.resize(input.result.size());
  const auto expectIn = [&](size_t begin, size_t end) {
    ExpectedSums sums;
    for (size_t face = begin; face < end; ++face) {
      result.expected[face] = 0;
      if (std::isnan(input.result[face])) continue;
      const double traced = input.traced.values[face], indicator = indicatorOf(input, face);
      const bool isInterpolated = std::isnan(traced);
      result.expected[face] = isInterpolated ? gain * ratio * indicator * unit : std::abs(input.result[face] - traced);
      if (isInterpolated) {
        sums.interpolatedIndicator += indicator;
        ++sums.interpolatedCount;
      }
      sums.error += result.expected[face] / unit;
      ++sums.count;
    }
    return sums;
  };
  const ExpectedSums sums = foldInParallel<ExpectedSums>(input.result.size(), expectIn, std::plus<>());
  const auto count = static_cast<double>(sums.count);
  const double scale = 1 / (count * (range / unit));
  estimateRelativeErrors(input, measured, gain, sums.interpolatedCount, result.estimate);
  result.estimate.robustAverage = sums.error / count / (robustRange(input.result) / unit);
  result.estimate.average = sums.error * scale;
  result.estimate.standardError =
      gain * std::hypot(ratioDeviation, gainDeviation * ratio) * sums.interpolatedIndicator * scale;
  result.estimate.heldOutCount = measured.size();
  result.estimate.worstFaces = worstOf(mesh, measured, range);
  return result;
}

}  // namespace asdfvk
