#include "describe/report_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "core/text.h"
#include "describe/comparison_text.h"
#include "describe/computation_options.h"

namespace asdfvk {
namespace {

/// Greatest numbers of parts whose areas the short and the full report list.
constexpr size_t kMaxShortParts = 3, kMaxListedParts = 10;

/// A share in percent, rounded down: "99.95 %" for 1999 of 2000.
std::string percent(uint64_t part, uint64_t whole) {
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  return fmt::format("{} %", std::floor(share * 100) / 100);
}

/// The end of a row about the mesh.
std::string chordErrorText(const Report& report) {
  return report.chordError > 0 ? fmt::format(", chord error {:.3g}", report.chordError) : "";
}

std::string meshRow(const Report& report) {
  std::string text = counted(report.faceCount, "face");
  if (report.triangleCount != report.faceCount) text += fmt::format(" ({})", counted(report.triangleCount, "triangle"));
  return text +
         fmt::format(", {}, {}", counted(report.vertexCount, "vertex", "vertices"),
                     counted(report.componentCount, "component")) +
         (report.unit.empty() ? "" : ", unit " + report.unit) + chordErrorText(report);
}

std::string shortValueRow(const Report& report) {
  std::string text = std::isfinite(report.sdf.median)
                         ? fmt::format("{} to {}, median {}", lengthText(report.sdf.min), lengthText(report.sdf.max),
                                       lengthText(report.sdf.median))
                         : std::string("none");
  if (report.noValueCount > 0) text += fmt::format("; {} without a value", counted(report.noValueCount, "face"));
  return text;
}

/// A share in percent, with two significant digits or as a whole number.
std::string twoDigits(double share) {
  return std::abs(share) < 0.1 ? fmt::format("{:.2g}", 100 * share) : fmt::format("{:.0f}", 100 * share);
}

std::string tracedCheck(const CheckReport& check) {
  if (!check.independent) return "the reference traced the rays: nothing to compare";
  if (check.tracedCount == 0) return "no face could be traced, so nothing was compared";
  const uint64_t withValue = check.tracedCount - check.noValueAgreeCount;
  if (withValue == 0)
    return fmt::format("{}, none with a value in either computation: nothing to compare",
                       counted(check.tracedCount, "traced face"));
  std::string text =
      fmt::format("{} of {} within {:g} of the diagonal; median difference {:.2g}, worst {:.2g} (face {})",
                  percent(check.agreeingCount, withValue), counted(withValue, "traced face"), kAgreementTolerance,
                  check.medianDifference, check.worstDifference, check.worstFace);
  if (check.noValueAgreeCount > 0)
    text += fmt::format("; {} more without a value in either computation", groupDigits(check.noValueAgreeCount));
  return text;
}

std::string shortErrorRow(const Report& report) {
  if (report.check) {
    const CheckReport& check = *report.check;
    if (check.tracedCount == 0 && check.independent) return tracedCheck(check);
    return fmt::format("{:.2g} % of the range on average, against the reference; {}", 100 * check.averageError,
                       check.independent
                           ? fmt::format("{} of {} agree", groupDigits(check.tracedCount - check.missCount()),
                                         counted(check.tracedCount, "traced face"))
                           : "nothing to compare: the reference traced the rays");
  }
  const ErrorEstimate& estimate = *report.estimatedError;
  std::string text = fmt::format("about {:.2g} % of the range on average", 100 * estimate.average);
  // The median is 0 if most faces cast rays; "0 %" would suggest that there are no errors.
  if (estimate.relativeMedian > 0)
    text += fmt::format(", {} % of the value in the median", twoDigits(estimate.relativeMedian));
  return text;
}

/// The text of the segments: "7 (5 to 9 at nearby detail); the largest 53, 16 and 7.1 % of the area".
std::string shortSegmentRow(const Report& report) {
  std::string text = groupDigits(*report.segmentCount);
  if (!report.parts) return text;
  const PartsReport& parts = *report.parts;
  if (parts.fewestCount != parts.mostCount)
    text += fmt::format(" ({} to {} at nearby detail)", groupDigits(parts.fewestCount), groupDigits(parts.mostCount));
  std::vector<double> shares = parts.areaShares;
  if (shares.size() < 2) return text;
  std::sort(shares.begin(), shares.end(), std::greater<>());
  const size_t count = std::min(shares.size(), kMaxShortParts);
  text += shares.size() > count ? "; the largest " : "; ";
  for (size_t i = 0; i < count; ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 == count ? " and " : ", ", twoDigits(shares[i]));
  return text + " % of the area";
}

std::string sizeRow(const Report& report) {
  return fmt::format("{:.6g} x {:.6g} x {:.6g}, bounding box{}", report.size.x, report.size.y, report.size.z,
                     report.unit.empty() ? "" : " in " + report.unit);
}

std::string seedRow(const Report& report) {
  std::string text =
      fmt::format("{} of {} cast {}, random seed {}", groupDigits(report.seedCount),
                  counted(report.triangleCount, "triangle"), counted(report.rayCount, "ray"), report.randomSeed);
  if (report.roundCount > 1) text += fmt::format(", {} rounds", report.roundCount);
  if (report.redoneConeCount > 0) text += fmt::format("; {} by the reference", counted(report.redoneConeCount, "cone"));
  return text;
}

std::string estimateRow(const ErrorEstimate& estimate) {
  std::string text = fmt::format("standard error {:.2g} %, 90 % of the faces within {:.3g} % of their value, by {}",
                                 100 * estimate.standardError, 100 * estimate.relativePercentile90,
                                 counted(estimate.heldOutCount, "held-out face"));
  if (!estimate.worstFaces.empty())
    text += fmt::format("; worst {:.3g} % of the range, face {}", 100 * estimate.worstFaces.front().error,
                        estimate.worstFaces.front().face);
  return text;
}

std::string partRow(const PartsReport& parts) {
  std::string text = "in order of the parts";
  for (size_t i = 0; i < std::min(parts.areaShares.size(), kMaxListedParts); ++i)
    text += fmt::format("{} {}", i == 0 ? "" : ",", twoDigits(parts.areaShares[i]));
  text += parts.areaShares.size() > kMaxListedParts ? ", ... %" : " %";
  if (parts.agreement) text += fmt::format("; agreement {:.2g}", *parts.agreement);
  if (parts.boundaries.empty()) return text;
  const auto [least, greatest] =
      std::minmax_element(parts.boundaries.begin(), parts.boundaries.end(),
                          [](const PartBoundary& a, const PartBoundary& b) { return a.stability < b.stability; });
  return text + fmt::format("; stability of boundaries {:.2g} to {:.2g}", least->stability, greatest->stability);
}

std::string deviceRow(const Report& report) {
  if (!report.traceChoice) return report.device;
  return fmt::format("{}; kernel {}, fetch {}", report.device, nameOf(kKernels, *report.traceChoice->kernel),
                     nameOf(kFetches, *report.traceChoice->fetch));
}

std::string solverRow(const SolverReport& solver) {
  return fmt::format("{}, {}, relative residual {:.2g}{}{}", solver.name, counted(solver.iterations, "iteration"),
                     solver.relativeResidual, solver.converged ? "" : ", not converged",
                     solver.finishedOnCpu ? ", finished on the CPU" : "");
}

double sumOf(const StageSeconds& seconds) {
  return std::accumulate(seconds.seconds.begin(), seconds.seconds.end(), 0.0);
}

std::string timeRow(const StageSeconds& seconds) {
  std::string stages;
  for (size_t i = 0; i < kStageCount; ++i)
    if (seconds.seconds[i] > 0) stages += fmt::format(", {} {:.2g}", nameOf(static_cast<Stage>(i)), seconds.seconds[i]);
  return fmt::format("{:.3g} s{}", sumOf(seconds), stages);
}

std::string deviceTimeRow(const DeviceTimes& times) {
  std::string row = "kernels " + timeRow(times.kernels);
  if (sumOf(times.copies) > 0) row += "; copies " + timeRow(times.copies);
  if (times.raysPerSecond > 0)
    row += fmt::format("; {:.3g} million rays per second of kernels", times.raysPerSecond / 1e6);
  return row;
}

/// On a GPU, a hint if rays from all faces would take less time than seeds and interpolation took; else empty.
std::string allSeedsRow(const Report& report, OptionSpelling spelling) {
  if (!report.deviceTimes || report.runsOnCpu || report.seedCount == 0 || report.seedCount >= report.triangleCount)
    return {};
  const double ofAll = report.deviceTimes->kernels[Stage::Trace] * static_cast<double>(report.triangleCount) /
                       static_cast<double>(report.seedCount);
  double spent = 0;
  for (const Stage stage : {Stage::Sample, Stage::Trace, Stage::Predict, Stage::Solve, Stage::Estimate})
    spent += report.stageSeconds[stage];
  if (ofAll >= spent) return {};
  const std::string option = withSpelledOptions("{seeds=all}", spelling);
  return fmt::format("{} would trace for about {:.2g} s here, instead of {:.2g} s for seeds and interpolation", option,
                     ofAll, spent);
}

/// The rows of the full report without the lists of thin regions. Titles are capitalised. A row that continues another
/// row is appended to that row.
ReportRows summaryRows(const Report& report, bool showsTimes, OptionSpelling spelling) {
  ReportRows summary;
  constexpr std::array kListed{"walls", "gaps", "details", "edges"};
  bool isThinRow = false;
  for (auto& [title, text] : reportRows(report, spelling)) {
    constexpr std::array kOfMachine{"choice", "time", "rate", "on device", "faster"};
    if (!showsTimes && std::find(kOfMachine.begin(), kOfMachine.end(), title) != kOfMachine.end()) continue;
    if (title == "device" && report.backend != nameOf(kBackendNames, BackendChoice::Vulkan))
      continue;  // The name of a CPU has the number of threads.
    if (!title.empty()) isThinRow = std::find(kListed.begin(), kListed.end(), title) != kListed.end();
    if (title.empty()) {
      if (!isThinRow) summary.back().second += "; " + text;
      continue;
    }
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
    summary.emplace_back(std::move(title), std::move(text));
  }
  return summary;
}

std::string errorSentence(const Report& report) {
  if ((report.thickness || report.gap) && report.seedCount == 0)
    return "The thickness is measured at every face, so no value is interpolated.";
  if (report.seedCount >= report.triangleCount) return "Every face cast rays, so no value is interpolated.";
  if (!report.estimatedError)
    return "The values between the seeds are interpolated; their error was not estimated in this computation.";
  const ErrorEstimate& estimate = *report.estimatedError;
  return fmt::format(
      "The values between the seeds are interpolated. Compared with rays from every face they are expected to differ "
      "by {:.2f} % of the range of all values on average (standard error {:.2f} %), and by at most {:.3g} % of the "
      "value at half of the faces and {:.3g} % at 90 % of them. The estimate is from {} faces that were held out.",
      100 * estimate.average, 100 * estimate.standardError, 100 * estimate.relativeMedian,
      100 * estimate.relativePercentile90, groupDigits(estimate.heldOutCount));
}

}  // namespace

ReportRows shortReportRows(const Report& report, OptionSpelling spelling) {
  constexpr size_t kMaxRows = 5;
  ReportRows rows;
  bool hasDiameter = true;
  if (report.thickness || report.gap) {
    rows = shortThicknessRows(report.thickness ? *report.thickness : *report.gap, spelling);
    if (report.comparison) {
      rows.front().second = comparisonSentence(report);
      std::erase_if(rows, [](const auto& row) { return row.first == "thickness"; });
      for (auto& row : comparisonRows(report)) rows.push_back(std::move(row));
    }
    for (auto& row : spaceRows(report)) rows.push_back(std::move(row));
    if (std::string question = unitQuestion(report); !question.empty())
      rows.emplace_back("unit", std::move(question));
    else
      rows.emplace_back(
          "mesh", fmt::format("{}, bounding box {:.4g} x {:.4g} x {:.4g}{}{}", counted(report.faceCount, "face"),
                              report.size.x, report.size.y, report.size.z, report.unit.empty() ? "" : " " + report.unit,
                              chordErrorText(report)));
    // Parts and the result of a check were asked for, so they come before the diameter if there is not room for all.
    const size_t askedCount = (report.segmentCount ? 1U : 0U) + (report.check ? 1U : 0U);
    hasDiameter = report.seedCount > 0 && rows.size() + askedCount < kMaxRows;
  } else {
    rows = {{"mesh", meshRow(report)}};
  }
  if (hasDiameter) rows.emplace_back("diameter", shortValueRow(report));
  if (report.segmentCount) rows.emplace_back(report.parts ? "parts" : "segments", shortSegmentRow(report));
  // If there is no room for the result of a check, the error message still reports a failed check.
  if (((report.estimatedError && hasDiameter) || report.check) && rows.size() < kMaxRows)
    rows.emplace_back("error", shortErrorRow(report));
  return rows;
}

ReportRows reportRows(const Report& report, OptionSpelling spelling) {
  const bool isMeasured = report.thickness || report.gap;
  ReportRows rows = isMeasured ? thicknessRows(report, spelling) : shortReportRows(report, spelling);
  const bool hasDiameter = report.seedCount > 0;
  if (isMeasured) {
    rows.emplace_back("mesh", meshRow(report));
    if (hasDiameter) rows.emplace_back("diameter", shortValueRow(report));
    if (report.segmentCount) rows.emplace_back(report.parts ? "parts" : "segments", shortSegmentRow(report));
    if (report.estimatedError || report.check) rows.emplace_back("error", shortErrorRow(report));
  } else {
    rows.emplace_back("size", sizeRow(report));
  }
  if (hasDiameter && report.sdf.robustRange() > 0)
    rows.emplace_back("spread", fmt::format("98 % of the faces have {} to {}", lengthText(report.sdf.percentile1),
                                            lengthText(report.sdf.percentile99)));
  if (report.parts) rows.emplace_back("areas", partRow(*report.parts));
  if (report.estimatedError) rows.emplace_back("estimate", estimateRow(*report.estimatedError));
  if (report.check) rows.emplace_back("check", tracedCheck(*report.check));
  if (report.postprocess)
    rows.emplace_back("smoothed", fmt::format("{} to {}, which become 0 and 1", lengthText(report.postprocess->min),
                                              lengthText(report.postprocess->max)));
  if (hasDiameter) rows.emplace_back("seeds", seedRow(report));
  if (report.regionFaceCount != report.faceCount) rows.emplace_back("region", counted(report.regionFaceCount, "face"));
  if (report.clampedCount > 0)
    rows.emplace_back("clamped", fmt::format("{}, to the range of the seeds of its component",
                                             counted(report.clampedCount, "triangle")));
  if (report.reversedFaceCount > 0) rows.emplace_back("reversed", counted(report.reversedFaceCount, "face"));
  rows.emplace_back("backend", report.backend);
  if (const std::string reason = backendReason(report, spelling); !reason.empty()) rows.emplace_back("choice", reason);
  rows.emplace_back("device", deviceRow(report));
  if (!report.solver.name.empty() && report.solver.name != "none")
    rows.emplace_back("solver", solverRow(report.solver));
  if (report.raysPerSecond > 0)
    rows.emplace_back("rate", fmt::format("{:.3g} million rays per second", report.raysPerSecond / 1e6));
  rows.emplace_back("time", timeRow(report.stageSeconds));
  if (report.deviceTimes && hasDiameter) rows.emplace_back("on device", deviceTimeRow(*report.deviceTimes));
  if (const std::string hint = allSeedsRow(report, spelling); !hint.empty()) rows.emplace_back("faster", hint);
  return rows;
}

std::string backendReason(const Report& report, OptionSpelling spelling) {
  if (report.leastRaysForGpu)
    return fmt::format("{} {} rays from which a GPU is faster", report.runsOnCpu ? "fewer than the" : "at least the",
                       groupDigits(*report.leastRaysForGpu));
  if (!report.runsOnCpu || report.backend != nameOf(kBackendNames, BackendChoice::Vulkan)) return {};
  return withSpelledOptions("a CPU device; {backend=cpu} is faster", spelling);
}

std::string checkFailure(const CheckReport& check) { return "the check failed: " + tracedCheck(check); }

std::string textWarning(const Warning& warning, OptionSpelling spelling) {
  std::string remedy;
  for (const ErrorDetail& detail : warning.details) {
    if (detail.name != "cause") continue;
    if (detail.value.starts_with("inverted")) remedy += "; {orient=auto} reverses inverted components";
    if (detail.value.ends_with("open")) remedy += "; {orient=flip} reverses all faces";
  }
  if (warning.code == WarningCode::InvertedComponents) remedy += "; {orient=auto} reverses inverted components";
  if (warning.code == WarningCode::ThinShell) remedy += "; fewer parts: {detail=0.5}, more: {detail=2}";
  if (warning.code == WarningCode::UncertainParts) remedy += "; look at the parts, and choose {parts=N} or {detail=X}";
  if (warning.code == WarningCode::CoarseParts) remedy += "; subdivide or remesh the mesh";
  if (warning.code == WarningCode::FinishedOnCpu) remedy += "; {solver=cpu} may be faster here";
  if (warning.code == WarningCode::RangeDominated)
    remedy += spelling == OptionSpelling::Flag ? "; use the relative error (--max-error E%rel)"
                                               : "; use the relative error ({max-relative-error})";
  if (warning.code == WarningCode::NotConverged) remedy += "; raise {max-iterations} or {tolerance}";
  return warning.message + withSpelledOptions(remedy, spelling);
}

ReportTexts reportTexts(const Report& report, bool showsTimes, OptionSpelling spelling) {
  ReportTexts texts{.summary = summaryRows(report, showsTimes, spelling), .errorSentence = errorSentence(report)};
  for (const Warning& warning : report.warnings)
    (warning.code == WarningCode::MeshDefect ? texts.defects : texts.warnings)
        .push_back(textWarning(warning, spelling));
  return texts;
}

}  // namespace asdfvk
