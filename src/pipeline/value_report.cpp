#include "pipeline/value_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "core/median.h"
#include "core/text.h"

namespace asdfvk {
namespace {

// The range is no scale for errors where the robust range is below this share of it, or where the median relative error
// is large and far above the average error over the range. No clean mesh is near (docs/accuracy.md).
constexpr double kMinRobustShare = 0.1, kLargeRelativeError = 0.1, kMaxRelativeOverAverage = 5;

/// Likely reasons of missing values.
struct MissingCauses {
  bool isInverted = false;  ///< A face without a value belongs to an inverted component.
  bool isOpen = false;      ///< A face without a value belongs to an open component.
};

MissingCauses causesOf(const PreparedMesh& prepared, const FaceDomain& domain, std::span<const double> values) {
  std::vector<uint8_t> isInverted(prepared.components.components.size(), 0);
  for (const uint32_t index : prepared.invertedComponents) isInverted[index] = 1;
  MissingCauses causes;
  for (uint32_t f = 0; f < prepared.mesh.faceCount(); ++f) {
    if (!std::isnan(values[f]) || prepared.geometry.isDegenerate(f) || !domain.contains(prepared.mesh.inputFaceOf(f)))
      continue;
    const uint32_t component = prepared.components.componentOf[f];
    causes.isInverted = causes.isInverted || isInverted[component];
    causes.isOpen = causes.isOpen || !prepared.components.components[component].isClosed;
  }
  causes.isOpen = causes.isOpen && prepared.defects.boundaryEdgeCount > 0;
  return causes;
}

Warning missingValues(const Report& report, const MissingCauses& causes, bool keepsMissing) {
  Warning warning{WarningCode::MissingValues,
                  fmt::format("{} of {} without a value: no ray from these faces{} hit the opposite side of the shape",
                              report.noValueCount, counted(report.regionFaceCount, "face"),
                              keepsMissing ? "" : ", or from faces connected to them,"),
                  {}};
  const std::string inverted = "their component is inverted";
  const std::string open = "the surface is open, so that rays escape, or its faces are oriented inwards";
  if (causes.isInverted) warning.details.push_back({"cause", "inverted"});
  if (causes.isOpen) warning.details.push_back({"cause", "open"});
  if (causes.isInverted || causes.isOpen)
    warning.message += ", most likely because " + (causes.isInverted ? inverted : std::string()) +
                       (causes.isInverted && causes.isOpen ? ", or " : "") + (causes.isOpen ? open : std::string());
  return warning;
}

ValueRange rangeOf(const std::vector<double>& values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present), [](double v) { return !std::isnan(v); });
  if (present.empty()) return {};
  const auto [low, high] = std::minmax_element(present.begin(), present.end());
  ValueRange range{.min = *low, .max = *high};
  range.median = upperMedian(present);
  range.percentile1 = percentileOf(present, 0.01);
  range.percentile99 = percentileOf(present, 0.99);
  return range;
}

/// The warning where errors over the range are reported and look small only because of the range.
std::optional<Warning> rangeDominated(const Report& report) {
  if (!report.estimatedError && !report.check) return std::nullopt;
  const double robustShare = report.sdf.robustRange() / (report.sdf.max - report.sdf.min);
  const ErrorEstimate estimate = report.estimatedError.value_or(ErrorEstimate{});
  const bool isLarge = estimate.relativeMedian > kLargeRelativeError &&
                       estimate.relativeMedian > kMaxRelativeOverAverage * estimate.average;
  if (!isLarge && !(robustShare < kMinRobustShare)) return std::nullopt;
  Warning warning{WarningCode::RangeDominated,
                  fmt::format("a few faces have most of the range of the values (98 % of the faces are within {:.2g} % "
                              "of it), so that errors over the range look small",
                              100 * robustShare),
                  {{"robustShare", fmt::format("{:.6g}", robustShare)}}};
  if (isLarge)
    warning.message = fmt::format(
        "most values are small against their range, so that errors over the range look small: {:.2g} % of the range on "
        "average, but {:.0f} % of the value in the median",
        100 * estimate.average, 100 * estimate.relativeMedian);
  return warning;
}

}  // namespace

uint64_t countWithoutValue(const FaceDomain& domain, std::span<const double> field) {
  uint64_t count = 0;
  for (size_t i = 0; i < field.size(); ++i) count += std::isnan(field[i]) && domain.contains(i) ? 1 : 0;
  return count;
}

void describeValues(Report& report, const PreparedMesh& prepared, const FaceDomain& domain,
                    const std::vector<double>& sdf, std::span<const double> values, bool keepsMissing) {
  report.sdf = rangeOf(sdf);
  report.noValueCount = countWithoutValue(domain, sdf);
  if (report.noValueCount > 0)
    report.warnings.push_back(missingValues(report, causesOf(prepared, domain, values), keepsMissing));
  if (std::optional<Warning> warning = rangeDominated(report)) report.warnings.push_back(std::move(*warning));
  if (report.solver.finishedOnCpu)
    report.warnings.push_back(
        {WarningCode::FinishedOnCpu,
         fmt::format("the {} solver reached the limit of float32 on the device; the CPU continued in double precision",
                     report.solver.name),
         {}});
  if (!report.solver.converged)
    report.warnings.push_back(
        {WarningCode::NotConverged,
         fmt::format("the {} solver stopped after {} at a relative residual of {:.1e}", report.solver.name,
                     counted(report.solver.iterations, "iteration"), report.solver.relativeResidual),
         {}});
}

}  // namespace asdfvk
