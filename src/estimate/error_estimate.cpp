#include "estimate/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

constexpr size_t kWorstFaceCount = 5;

// Held-out faces are seeds of the result, which lowers its error by about these powers of the number of seeds. The
// powers differ between meshes by as much again (docs/experiments.md).
constexpr double kGainExponent = 0.12, kGainExponentWithoutPrediction = 0.5;

/// Of the traced values. The range of the function is wider where its extremes were not traced.
double tracedRange(const EstimateInput& input) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const uint32_t face : input.traced.faces)
    if (const double value = input.traced.values[face]; !std::isnan(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return high > low ? high - low : 0;
}

/// Error indicator of a face.
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
  double error = 0, indicator = 0, weight = 0;
};

/// Of the held-out faces with a value.
std::vector<Measurement> measureErrors(const EstimateInput& input) {
  std::vector<Measurement> measured;
  for (size_t i = 0; i < input.heldOut.faces.size(); ++i) {
    const uint32_t face = input.heldOut.faces[i];
    const Measurement measurement{face, std::abs(input.withoutHeldOut[face] - input.traced.values[face]),
                                  indicatorOf(input, face), input.heldOut.weights[i]};
    if (!std::isnan(measurement.error) && !std::isnan(input.result[face])) measured.push_back(measurement);
  }
  return measured;
}

std::vector<ErrorEstimate::WorstFace> worstOf(const TriangleMesh& mesh, std::vector<Measurement> measured,
                                              double range) {
  const size_t count = std::min(kWorstFaceCount, measured.size());
  std::partial_sort(measured.begin(), measured.begin() + static_cast<std::ptrdiff_t>(count), measured.end(),
                    [](const Measurement& a, const Measurement& b) {
                      return a.error != b.error ? a.error > b.error : a.face < b.face;
                    });
  std::vector<ErrorEstimate::WorstFace> worst;
  for (size_t i = 0; i < count; ++i) worst.push_back({mesh.inputFaceOf(measured[i].face), measured[i].error / range});
  return worst;
}

}  // namespace

EstimatedErrors estimateErrors(const TriangleMesh& mesh, const EstimateInput& input) {
  EstimatedErrors result;
  result.expected.assign(input.result.size(), 0);
  const double range = tracedRange(input);
  const std::vector<Measurement> measured = measureErrors(input);
  // Faces with inclusion probability 1 represent only themselves.
  const auto representativeCount =
      std::count_if(measured.begin(), measured.end(), [](const Measurement& m) { return m.weight > 0; });
  if (representativeCount < 2 || !(range > 0)) return result;

  double errorSum = 0, indicatorSum = 0;
  for (const Measurement& m : measured) {
    errorSum += m.weight * m.error;
    indicatorSum += m.weight * m.indicator;
  }
  const double ratio = errorSum / indicatorSum;
  double squareSum = 0;
  for (const Measurement& m : measured) squareSum += std::pow(m.weight * (m.error - ratio * m.indicator), 2);
  const auto sampleSize = static_cast<double>(representativeCount);
  const double ratioDeviation = std::sqrt(squareSum * sampleSize / (sampleSize - 1)) / indicatorSum;
  const double gain = gainBySeeds(input), gainDeviation = 1 - gain;

  double sum = 0, interpolatedIndicator = 0;
  size_t count = 0;
  for (size_t face = 0; face < input.result.size(); ++face) {
    if (std::isnan(input.result[face])) continue;
    const double traced = input.traced.values[face], indicator = indicatorOf(input, face);
    const bool isInterpolated = std::isnan(traced);
    result.expected[face] = isInterpolated ? gain * ratio * indicator : std::abs(input.result[face] - traced);
    if (isInterpolated) interpolatedIndicator += indicator;
    sum += result.expected[face];
    ++count;
  }
  const double scale = 1 / (static_cast<double>(count) * range);
  result.estimate.average = sum * scale;
  result.estimate.standardError =
      gain * std::hypot(ratioDeviation, gainDeviation * ratio) * interpolatedIndicator * scale;
  result.estimate.heldOutCount = measured.size();
  result.estimate.worstFaces = worstOf(mesh, measured, range);
  return result;
}

}  // namespace asdfvk
