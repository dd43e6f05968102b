#include "pipeline/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

constexpr size_t kWorstFaceCount = 5;

// Of the mean disagreement of both methods: what is expected of a face where they agree.
constexpr double kLeastExpectation = 0.5;

/// Of the values traced. The function's own range is wider where its extremes were not traced.
double tracedRange(const HeldOutErrors& errors) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const uint32_t face : errors.traced.faces)
    if (const double value = errors.traced.values[face]; !std::isnan(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return high > low ? high - low : 0;
}

/// How great the errors are expected to be, up to a factor; NaN where there is no value.
std::vector<double> patternOf(const HeldOutErrors& errors) {
  std::vector<double> pattern(errors.values.size(), 1.0);
  if (!errors.otherValues.empty()) {
    double sum = 0;
    size_t count = 0;
    for (size_t face = 0; face < pattern.size(); ++face) {
      pattern[face] = std::abs(errors.values[face] - errors.otherValues[face]);
      if (std::isnan(pattern[face])) continue;
      sum += pattern[face];
      ++count;
    }
    const double least = count > 0 ? kLeastExpectation * sum / static_cast<double>(count) : 0;
    for (double& entry : pattern) entry += least > 0 ? least : 1;
  }
  for (size_t face = 0; face < pattern.size(); ++face)
    if (std::isnan(errors.result[face])) pattern[face] = kNoValue;
  return pattern;
}

struct Probe {
  uint32_t face = 0;
  double error = 0, pattern = 0;
};

std::vector<Probe> readProbes(const HeldOutErrors& errors, const std::vector<double>& pattern) {
  std::vector<Probe> probes;
  for (const uint32_t face : errors.probes) {
    const Probe probe{face, std::abs(errors.values[face] - errors.traced.values[face]), pattern[face]};
    if (!std::isnan(probe.error) && !std::isnan(probe.pattern)) probes.push_back(probe);
  }
  return probes;
}

std::vector<ErrorEstimate::WorstFace> worstOf(const Mesh& mesh, std::vector<Probe> probes, double range) {
  const size_t count = std::min(kWorstFaceCount, probes.size());
  std::partial_sort(
      probes.begin(), probes.begin() + static_cast<std::ptrdiff_t>(count), probes.end(),
      [](const Probe& a, const Probe& b) { return a.error != b.error ? a.error > b.error : a.face < b.face; });
  std::vector<ErrorEstimate::WorstFace> worst;
  for (size_t i = 0; i < count; ++i) worst.push_back({mesh.inputFaceOf(probes[i].face), probes[i].error / range});
  return worst;
}

}  // namespace

EstimatedErrors estimateErrors(const Mesh& mesh, const HeldOutErrors& errors) {
  EstimatedErrors result;
  result.expected.assign(errors.result.size(), 0);
  const double range = tracedRange(errors);
  const std::vector<double> pattern = patternOf(errors);
  const std::vector<Probe> probes = readProbes(errors, pattern);
  if (probes.size() < 2 || !(range > 0)) return result;

  double errorSum = 0, patternSum = 0;
  for (const Probe& probe : probes) {
    errorSum += probe.error;
    patternSum += probe.pattern;
  }
  const double ratio = errorSum / patternSum;
  double squareSum = 0;
  for (const Probe& probe : probes) squareSum += std::pow(probe.error - ratio * probe.pattern, 2);
  const auto probeCount = static_cast<double>(probes.size());

  double sum = 0, interpolatedPattern = 0;
  size_t count = 0;
  for (size_t face = 0; face < pattern.size(); ++face) {
    if (std::isnan(pattern[face])) continue;
    const double traced = errors.traced.values[face];
    const bool isInterpolated = std::isnan(traced);
    result.expected[face] = isInterpolated ? ratio * pattern[face] : std::abs(errors.result[face] - traced);
    if (isInterpolated) interpolatedPattern += pattern[face];
    sum += result.expected[face];
    ++count;
  }
  const double scale = 1 / (static_cast<double>(count) * range);
  result.estimate.average = sum * scale;
  result.estimate.standardError = std::sqrt(squareSum / (probeCount * (probeCount - 1))) *
                                  (interpolatedPattern / (patternSum / probeCount)) * scale;
  result.estimate.heldOutCount = probes.size();
  result.estimate.worstFaces = worstOf(mesh, probes, range);
  return result;
}

}  // namespace asdfvk
