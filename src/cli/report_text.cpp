#include "cli/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "asdf_vk/choices.h"
#include "cli/exit_code.h"
#include "core/text.h"

namespace asdfvk {
namespace {

/// Parts whose areas are listed.
constexpr size_t kMaxListedParts = 12, kMaxShortParts = 3;

/// 99.95 % of 1999 agreeing of 2000; never rounded up to 100.
std::string percent(uint64_t part, uint64_t whole) {
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  return fmt::format("{} %", std::floor(share * 100) / 100);
}

std::string meshRow(const Report& report) {
  std::string text = groupedCount(report.faceCount, "face");
  if (report.triangleCount != report.faceCount)
    text += fmt::format(" ({})", groupedCount(report.triangleCount, "triangle"));
  return text + fmt::format(", {}, {}",
                            report.vertexCount == 1 ? "1 vertex" : groupDigits(report.vertexCount) + " vertices",
                            groupedCount(report.componentCount, "component"));
}

std::string seedRow(const MeshOutcome& outcome) {
  const Report& report = outcome.result.report;
  std::string text = fmt::format(
      "{} cast{} rays ({}), {} in all, recipe {}, random seed {}", groupedCount(report.seedCount, "face"),
      report.seedCount == 1 ? "s" : "", percent(report.seedCount, std::max<uint64_t>(1, report.triangleCount)),
      groupedCount(report.rayCount, "ray"), nameOf(kRecipes, outcome.computation.recipe), report.randomSeed);
  if (report.redoneConeCount > 0)
    text += fmt::format("; {} redone by the reference", groupedCount(report.redoneConeCount, "cone"));
  return text;
}

/// A stage with 0 s did not run.
std::string timeRow(const StageSeconds& seconds) {
  std::string text;
  for (size_t i = 0; i < kStageCount; ++i)
    if (const auto stage = static_cast<Stage>(i); seconds[stage] > 0)
      text += text.empty() ? fmt::format("{} {:.3f} s", nameOf(stage), seconds[stage])
                           : fmt::format(", {} {:.3f}", nameOf(stage), seconds[stage]);
  return text;
}

std::string kernelText(const TraceVariant& variant) {
  return fmt::format(", kernel {} {}", variant.kernel, variant.fetch);
}

std::string solverRow(const SolverReport& solver) {
  if (solver.name == "none") return "none: nothing to interpolate";
  return fmt::format("{}, {}, relative residual {:.2g}{}", solver.name, groupedCount(solver.iterations, "iteration"),
                     solver.relativeResidual, solver.converged ? "" : ", NOT CONVERGED");
}

std::string valueRow(const Report& report) {
  std::string text = std::isfinite(report.sdf.median) ? fmt::format("min {:.6g}, median {:.6g}, max {:.6g}",
                                                                    report.sdf.min, report.sdf.median, report.sdf.max)
                                                      : std::string("none");
  if (report.noValueCount > 0) text += fmt::format("; {} without a value", groupedCount(report.noValueCount, "face"));
  if (report.clampedCount > 0)
    text += fmt::format("; {} limited to the values of the seeds", groupedCount(report.clampedCount, "face"));
  return text;
}

std::string shortValueRow(const Report& report) {
  std::string text = std::isfinite(report.sdf.median) ? fmt::format("{:.4g} to {:.4g}, median {:.4g}", report.sdf.min,
                                                                    report.sdf.max, report.sdf.median)
                                                      : std::string("none");
  if (report.noValueCount > 0) text += fmt::format("; {} without a value", groupedCount(report.noValueCount, "face"));
  return text;
}

/// A share in percent: two digits, or all before the point.
std::string twoDigits(double share) {
  return std::abs(share) < 0.1 ? fmt::format("{:.2g}", 100 * share) : fmt::format("{:.0f}", 100 * share);
}

/// "41, 12 and 8.5", the largest first; at most kMaxListedParts.
std::string areaText(std::vector<double> shares) {
  std::sort(shares.begin(), shares.end(), std::greater<>());
  const size_t count = std::min(shares.size(), kMaxListedParts);
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    const char* separator = i == 0 ? "" : i + 1 == shares.size() ? " and " : ", ";
    text += separator + twoDigits(shares[i]);
  }
  if (shares.size() > count) text += fmt::format(" and {} more", groupDigits(shares.size() - count));
  return text;
}

ReportRows segmentRows(const Report& report, const Options& options) {
  const std::string count = groupDigits(*report.segmentCount);
  if (!report.parts)
    return {{"segments", fmt::format("{} from {} clusters, smoothness {:g}", count,
                                     options.cgalSegmentation.clusterCount, options.cgalSegmentation.smoothness)}};
  const PartsReport& parts = *report.parts;
  const std::string range = parts.fewestCount == parts.mostCount
                                ? groupDigits(parts.fewestCount)
                                : groupDigits(parts.fewestCount) + " to " + groupDigits(parts.mostCount);
  const double detail = options.parts.detail;
  const std::string when =
      options.parts.partCount
          ? fmt::format("if the cost limit changes by {:.0f} %", 100 * (kPartStabilityFactor - 1))
          : fmt::format("at --detail {:.3g} to {:.3g}", detail / kPartStabilityFactor, detail * kPartStabilityFactor);
  const std::string agreement = parts.agreement ? fmt::format("; agreement {:.2f}", *parts.agreement) : "";
  ReportRows rows{{"parts", fmt::format("{}; {} {}{}", count, range, when, agreement)}};
  if (parts.areaShares.size() > 1)
    rows.emplace_back("", fmt::format("of {} % of the area", areaText(parts.areaShares)));
  return rows;
}

std::string estimateRow(const Report& report) {
  const ErrorEstimate& estimate = *report.estimatedError;
  std::string text = fmt::format(
      "{:.2f} % +- {:.2f} of the range on average; relative error {} % +- {} in the median, {} % at the 90th "
      "percentile; from {} held-out faces",
      100 * estimate.average, 100 * estimate.standardError, twoDigits(estimate.relativeMedian),
      twoDigits(estimate.relativeMedianStandardError), twoDigits(estimate.relativePercentile90),
      groupDigits(estimate.heldOutCount));
  if (!estimate.worstFaces.empty())
    text += fmt::format("; {:.0f} % of the range at face {}", 100 * estimate.worstFaces[0].error,
                        estimate.worstFaces[0].face);
  return text + (report.roundCount > 1 ? fmt::format("; {} rounds", report.roundCount) : "");
}

std::string tracedCheck(const CheckReport& check) {
  if (!check.independent) return "the reference traced the rays: nothing to compare";
  if (check.tracedCount == 0) return "no face could be traced, so nothing was compared";
  const uint64_t withValue = check.tracedCount - check.noValueAgreeCount;
  if (withValue == 0)
    return fmt::format("{}, none with a value in either computation: nothing to compare",
                       groupedCount(check.tracedCount, "traced face"));
  std::string text =
      fmt::format("{} of {} within {:g} of the diagonal; median difference {:.2g}, worst {:.2g} (face {})",
                  percent(check.agreeingCount, withValue), groupedCount(withValue, "traced face"), kAgreementTolerance,
                  check.medianDifference, check.worstDifference, check.worstFace);
  if (check.noValueAgreeCount > 0)
    text += fmt::format("; {} more without a value in either computation", groupDigits(check.noValueAgreeCount));
  return text;
}

std::string errorCheck(const CheckReport& check) {
  return fmt::format("average error {:.4f}, maximum {:.4f} of the range over {}; {:.4f} and {:.4f} over the {}",
                     check.averageError, check.maximumError, groupedCount(check.comparedCount, "face"),
                     check.interpolatedAverageError, check.interpolatedMaximumError,
                     groupedCount(check.interpolatedCount, "interpolated face"));
}

std::string shortErrorRow(const Report& report) {
  if (report.check) {
    const CheckReport& check = *report.check;
    if (check.tracedCount == 0 && check.independent) return tracedCheck(check);
    return fmt::format("{:.2g} % of the range on average, by the reference; {}", 100 * check.averageError,
                       check.independent
                           ? fmt::format("{} of {} agree", groupDigits(check.tracedCount - check.missCount()),
                                         groupedCount(check.tracedCount, "traced face"))
                           : "nothing to compare: it traced the rays");
  }
  const ErrorEstimate& estimate = *report.estimatedError;
  return fmt::format("about {:.2g} % of the range on average, {} % of the value in the median", 100 * estimate.average,
                     twoDigits(estimate.relativeMedian));
}

/// "7 (5 to 9 at nearby detail); the largest 53, 16 and 7.1 % of the area"
std::string shortSegmentRow(const Report& report) {
  std::string text = groupDigits(*report.segmentCount);
  if (!report.parts) return text;
  const PartsReport& parts = *report.parts;
  if (parts.fewestCount != parts.mostCount)
    text += fmt::format(" ({} to {} at nearby detail)", groupDigits(parts.fewestCount), groupDigits(parts.mostCount));
  std::vector<double> shares = parts.areaShares;
  if (shares.size() < 2) return text;
  std::sort(shares.begin(), shares.end(), std::greater<>());
  const bool isLonger = shares.size() > kMaxShortParts;
  shares.resize(std::min(shares.size(), kMaxShortParts));
  return text + fmt::format("; {}{} % of the area", isLonger ? "the largest " : "", areaText(std::move(shares)));
}

/// At most four rows: with title and files, six lines.
ReportRows shortRows(const Report& report) {
  ReportRows rows;
  if (report.thickness) {
    rows = shortThicknessRows(*report.thickness);
    rows.emplace_back("mesh",
                      fmt::format("{}, bounding box {:.4g} x {:.4g} x {:.4g}", groupedCount(report.faceCount, "face"),
                                  report.size.x, report.size.y, report.size.z));
  } else {
    rows = {{"mesh", meshRow(report)}, {"diameter", shortValueRow(report)}};
  }
  if (report.segmentCount) rows.emplace_back(report.parts ? "parts" : "segments", shortSegmentRow(report));
  // The error of the diameter matters less than the thickness, and a failed check is an error message of its own.
  constexpr size_t kMaxRows = 5;
  if ((report.estimatedError && !report.thickness) || (report.check && rows.size() < kMaxRows))
    rows.emplace_back("error", shortErrorRow(report));
  return rows;
}

/// A GPU gains little where most of the time is not spent on rays. Estimated, not measured.
bool isTooSmallForGpu(const Report& report) {
  constexpr uint64_t kFewRays = 10'000'000;
  return report.traceChoice && !report.runsOnCpu && report.rayCount < kFewRays && isBackendBuilt("cpu");
}

}  // namespace

std::string groupedCount(uint64_t count, const char* singular, const char* plural) {
  if (count != 1 && plural != nullptr) return fmt::format("{} {}", groupDigits(count), plural);
  return fmt::format("{} {}{}", groupDigits(count), singular, count == 1 ? "" : "s");
}

ReportRows reportRows(const MeshOutcome& outcome) {
  const Report& report = outcome.result.report;
  ReportRows rows;
  const auto append = [&rows](ReportRows further) {
    for (auto& row : further) rows.push_back(std::move(row));
  };
  if (report.thickness) append(thicknessRows(report));
  rows.emplace_back("mesh", meshRow(report));
  if (!outcome.computation.options.measuresDiameter()) {
    rows.emplace_back("time", timeRow(report.stageSeconds));
    return rows;
  }
  rows.emplace_back("device",
                    fmt::format("{} on {}{}{}", report.backend, report.device,
                                report.traceChoice ? kernelText(*report.traceChoice) : "",
                                isTooSmallForGpu(report) ? "; so few rays may be faster with --backend cpu" : ""));
  rows.emplace_back("seeds", seedRow(outcome));
  rows.emplace_back("time", timeRow(report.stageSeconds));
  rows.emplace_back("speed", fmt::format("{:.3g} Mrays/s", report.raysPerSecond / 1e6));
  rows.emplace_back("solver", solverRow(report.solver));
  rows.emplace_back("diameter", valueRow(report));
  if (report.postprocess)
    rows.emplace_back("smoothed", fmt::format("min {:.6g}, max {:.6g}, mapped to 0 and 1", report.postprocess->min,
                                              report.postprocess->max));
  if (report.segmentCount) append(segmentRows(report, outcome.computation.options));
  if (report.estimatedError) rows.emplace_back("error", estimateRow(report));
  if (report.check) {
    rows.emplace_back("check", tracedCheck(*report.check));
    if (report.check->interpolatedCount > 0) rows.emplace_back("", errorCheck(*report.check));
  }
  return rows;
}

std::string textReport(const MeshOutcome& outcome) {
  ReportRows rows = outcome.outputs.verbose ? reportRows(outcome) : shortRows(outcome.result.report);
  const auto placeText = [](const std::string& place) { return place == "-" ? "standard output" : place; };
  std::string files = placeText(outcome.output);
  if (!outcome.outputs.points.empty()) files += ", points " + placeText(outcome.outputs.points);
  if (!outcome.outputs.picture.empty()) files += ", picture " + placeText(outcome.outputs.picture);
  rows.emplace_back("output", files);
  std::string text = fmt::format("{}: {}\n", outcome.mesh, rows.front().second);
  for (size_t i = 1; i < rows.size(); ++i) text += fmt::format("  {:<9} {}\n", rows[i].first, rows[i].second);
  return text;
}

std::string textWarning(const Warning& warning) {
  std::string text = warning.message;
  for (const ErrorDetail& detail : warning.details) {
    if (detail.name != "cause") continue;
    if (detail.value.starts_with("inverted")) text += "; --orient auto reverses inverted components";
    if (detail.value.ends_with("open")) text += "; --orient flip reverses all faces";
  }
  if (warning.code == WarningCode::InvertedComponents) text += "; --orient auto reverses inverted components";
  if (warning.code == WarningCode::ThinShell) text += "; fewer parts: --detail 0.5, more: --detail 2";
  if (warning.code == WarningCode::OnlySmallComponents) text += "; weld equal vertices if they are one surface";
  if (warning.code == WarningCode::FinishedOnCpu) text += "; --solver cpu may be faster here";
  if (warning.code == WarningCode::RangeDominated) text += "; use the relative error, as --max-error E%rel does";
  if (warning.code == WarningCode::NotConverged) text += "; raise --max-iterations or --tolerance";
  return text;
}

std::string checkFailure(const CheckReport& check) { return fmt::format("the check failed: {}", tracedCheck(check)); }

std::string deviceLinesOf(const Session& session, const SessionOptions& options, bool isVerbose) {
  std::vector<std::string> lines = session.deviceLines();
  const bool isReplaced = options.backend == "auto" && session.backend() != "vulkan";
  const bool isOtherPossible = options.device.empty() && session.runsOnCpu() && lines.size() > 1;
  if (!isVerbose && !isReplaced && !isOtherPossible) return {};
  if (session.backend() == "vulkan" && session.runsOnCpu() && isBackendBuilt("cpu"))
    lines.front() += "; a CPU device: --backend cpu (Embree) may be faster";
  std::string text;
  for (const std::string& line : lines) text += oneLine("asdf-vk: " + line) + "\n";
  return text;
}

std::string textDevices(std::span<const DeviceInfo> devices, const std::string& reason) {
  if (devices.empty()) return fmt::format("no Vulkan device: {}\n", reason);
  size_t nameWidth = 0, kindWidth = 0, driverWidth = 0;
  for (const DeviceInfo& device : devices) {
    nameWidth = std::max(nameWidth, device.name.size());
    kindWidth = std::max(kindWidth, device.kind.size());
    driverWidth = std::max(driverWidth, device.driver.size());
  }
  std::string text;
  for (size_t i = 0; i < devices.size(); ++i)
    text += fmt::format("{}  {:<{}}   {:<{}}   driver {:<{}}   {}{}\n", i, devices[i].name, nameWidth, devices[i].kind,
                        kindWidth, devices[i].driver, driverWidth,
                        devices[i].usable ? "" : "not usable: ", devices[i].reason);
  return text;
}

}  // namespace asdfvk
