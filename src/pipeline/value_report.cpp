#include "pipeline/value_report.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "core/percentiles.h"
#include "describe/warnings.h"

namespace asdfvk {
namespace {

// The range of the values is not a good scale for errors in two cases. Either the robust range is below this share of
// the range, or the median relative error is large and far above the average error over the range. No clean mesh is
// near these limits (docs/accuracy.md).
constexpr double kMinRobustShare = 0.1, kLargeRelativeError = 0.1, kMaxRelativeOverAverage = 5;

/// The warning about faces without a value, with its likely causes. sdf: #I.
Warning describeMissing(const Report& report, const PreparedMesh& prepared, const InputFaceSet& region,
                        std::span<const double> sdf, bool keepsMissing) {
  std::vector<uint8_t> isInverted(prepared.components.components.size(), 0);
  for (const uint32_t index : prepared.invertedComponents) isInverted[index] = 1;
  MissingValues missing{
      .count = report.noValueCount, .faceCount = report.regionFaceCount, .keepsMissing = keepsMissing};
  for (uint32_t f = 0; f < prepared.mesh.faceCount(); ++f) {
    const uint32_t inputFace = prepared.mesh.inputFaceOf(f);
    if (!std::isnan(sdf[inputFace]) || prepared.geometry.isDegenerate(f) || !region.contains(inputFace)) continue;
    const uint32_t component = prepared.components.componentOf[f];
    missing.isInverted = missing.isInverted || isInverted[component];
    missing.isOpen = missing.isOpen || !prepared.components.components[component].isClosed;
  }
  missing.isOpen = missing.isOpen && prepared.defects.boundaryEdgeCount > 0;
  return missingValues(missing);
}

ValueRange rangeOf(std::span<const double> values) {
  constexpr std::array<double, 5> kShares{0, 0.01, 0.5, 0.99, 1};
  const std::vector<double> at = percentilesOf(values, kShares);
  if (at.empty()) return {};
  return {at[0], at[1], at[2], at[3], at[4]};
}

/// The warning about reported errors over the range that look small only because the range is large.
std::optional<Warning> warningOfRange(const Report& report) {
  if (!report.estimatedError && !report.check) return std::nullopt;
  const double robustShare = report.sdf.robustRange() / (report.sdf.max - report.sdf.min);
  const ErrorEstimate estimate = report.estimatedError.value_or(ErrorEstimate{});
  const bool isLarge = estimate.relativeMedian > kLargeRelativeError &&
                       estimate.relativeMedian > kMaxRelativeOverAverage * estimate.average;
  if (!isLarge && !(robustShare < kMinRobustShare)) return std::nullopt;
  return isLarge ? rangeDominated(robustShare, estimate) : rangeDominated(robustShare);
}

}  // namespace

uint64_t countWithoutValue(const InputFaceSet& region, std::span<const double> field) {
  return countInParallel(field.size(), [&](uint32_t i) { return std::isnan(field[i]) && region.contains(i); });
}

void describeValues(Report& report, const PreparedMesh& prepared, const InputFaceSet& region,
                    const std::vector<double>& sdf, bool keepsMissing) {
  report.sdf = rangeOf(sdf);
  report.noValueCount = countWithoutValue(region, sdf);
  if (report.noValueCount > 0) report.warnings.push_back(describeMissing(report, prepared, region, sdf, keepsMissing));
  if (std::optional<Warning> warning = warningOfRange(report)) report.warnings.push_back(std::move(*warning));
  if (report.solver.finishedOnCpu) report.warnings.push_back(finishedOnCpu(report.solver));
  if (!report.solver.converged) report.warnings.push_back(notConverged(report.solver));
}

}  // namespace asdfvk
