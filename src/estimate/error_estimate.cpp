#include "estimate/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

constexpr size_t kWorstFaceCount = 5;

// With the probes among the seeds, the other faces err less than without: by about this power of the number of seeds,
// which differs from mesh to mesh by as much again (docs/experiments.md).
constexpr double kProbesWorth = 0.12;

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

/// How great the error of a face is expected to be, up to a factor.
double expectationOf(const HeldOutErrors& errors, size_t face) {
  return errors.pattern.empty() ? 1 : errors.pattern[face];
}

/// What the error of a face falls to once the probes are seeds.
double gainByProbes(const HeldOutErrors& errors) {
  const auto probeCount = static_cast<double>(errors.probes.faces.size()),
             seedCount = static_cast<double>(errors.traced.faces.size());
  return std::pow(1 - probeCount / seedCount, kProbesWorth);
}

struct Probe {
  uint32_t face = 0;
  double error = 0, expectation = 0, weight = 0;
};

/// Those with a value.
std::vector<Probe> readProbes(const HeldOutErrors& errors) {
  std::vector<Probe> probes;
  for (size_t i = 0; i < errors.probes.faces.size(); ++i) {
    const uint32_t face = errors.probes.faces[i];
    const Probe probe{face, std::abs(errors.values[face] - errors.traced.values[face]), expectationOf(errors, face),
                      errors.probes.weights[i]};
    if (!std::isnan(probe.error) && !std::isnan(errors.result[face])) probes.push_back(probe);
  }
  return probes;
}

std::vector<ErrorEstimate::WorstFace> worstOf(const TriangleMesh& mesh, std::vector<Probe> probes, double range) {
  const size_t count = std::min(kWorstFaceCount, probes.size());
  std::partial_sort(
      probes.begin(), probes.begin() + static_cast<std::ptrdiff_t>(count), probes.end(),
      [](const Probe& a, const Probe& b) { return a.error != b.error ? a.error > b.error : a.face < b.face; });
  std::vector<ErrorEstimate::WorstFace> worst;
  for (size_t i = 0; i < count; ++i) worst.push_back({mesh.inputFaceOf(probes[i].face), probes[i].error / range});
  return worst;
}

}  // namespace

EstimatedErrors estimateErrors(const TriangleMesh& mesh, const HeldOutErrors& errors) {
  EstimatedErrors result;
  result.expected.assign(errors.result.size(), 0);
  const double range = tracedRange(errors);
  const std::vector<Probe> probes = readProbes(errors);
  // Those that were chosen for certain speak for no other face.
  const auto spokesmanCount = std::count_if(probes.begin(), probes.end(), [](const Probe& p) { return p.weight > 0; });
  if (spokesmanCount < 2 || !(range > 0)) return result;

  double errorSum = 0, expectationSum = 0;
  for (const Probe& probe : probes) {
    errorSum += probe.weight * probe.error;
    expectationSum += probe.weight * probe.expectation;
  }
  const double ratio = errorSum / expectationSum;
  double squareSum = 0;
  for (const Probe& probe : probes) squareSum += std::pow(probe.weight * (probe.error - ratio * probe.expectation), 2);
  const auto sampleSize = static_cast<double>(spokesmanCount);
  const double ratioDeviation = std::sqrt(squareSum * sampleSize / (sampleSize - 1)) / expectationSum;
  const double gain = gainByProbes(errors), gainDeviation = 1 - gain;

  double sum = 0, interpolatedExpectation = 0;
  size_t count = 0;
  for (size_t face = 0; face < errors.result.size(); ++face) {
    if (std::isnan(errors.result[face])) continue;
    const double traced = errors.traced.values[face], expectation = expectationOf(errors, face);
    const bool isInterpolated = std::isnan(traced);
    result.expected[face] = isInterpolated ? gain * ratio * expectation : std::abs(errors.result[face] - traced);
    if (isInterpolated) interpolatedExpectation += expectation;
    sum += result.expected[face];
    ++count;
  }
  const double scale = 1 / (static_cast<double>(count) * range);
  result.estimate.average = sum * scale;
  result.estimate.standardError =
      gain * std::hypot(ratioDeviation, gainDeviation * ratio) * interpolatedExpectation * scale;
  result.estimate.heldOutCount = probes.size();
  result.estimate.worstFaces = worstOf(mesh, probes, range);
  return result;
}

}  // namespace asdfvk
