#include "cli/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "asdf_vk/choices.h"
#include "cli/exit_code.h"
#include "core/json.h"
#include "core/text.h"

namespace asdfvk {
namespace {

/// Parts whose areas are listed in the short report, and items of a list in the full one.
constexpr size_t kMaxShortParts = 3, kMaxListedItems = 5;

/// 99.95 % of 1999 agreeing of 2000; never rounded up to 100.
std::string percent(uint64_t part, uint64_t whole) {
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  return fmt::format("{} %", std::floor(share * 100) / 100);
}

std::string meshRow(const Report& report) {
  std::string text = groupedCount(report.faceCount, "face");
  if (report.triangleCount != report.faceCount)
    text += fmt::format(" ({})", groupedCount(report.triangleCount, "triangle"));
  return text +
         fmt::format(", {}, {}", report.vertexCount == 1 ? "1 vertex" : groupDigits(report.vertexCount) + " vertices",
                     groupedCount(report.componentCount, "component")) +
         (report.unit.empty() ? "" : ", unit " + report.unit);
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
  const size_t count = std::min(shares.size(), kMaxShortParts);
  text += shares.size() > count ? "; the largest " : "; ";
  for (size_t i = 0; i < count; ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 == count ? " and " : ", ", twoDigits(shares[i]));
  return text + " % of the area";
}

/// At most four rows: with title and files, six lines.
ReportRows shortRows(const Report& report) {
  ReportRows rows;
  if (report.thickness) {
    rows = shortThicknessRows(*report.thickness);
    rows.emplace_back(
        "mesh", fmt::format("{}, bounding box {:.4g} x {:.4g} x {:.4g}{}", groupedCount(report.faceCount, "face"),
                            report.size.x, report.size.y, report.size.z, report.unit.empty() ? "" : " " + report.unit));
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

/// "stage seconds" for the key "stageSeconds".
std::string wordsOf(const std::string& key) {
  std::string words;
  for (const char c : key)
    words += 'A' <= c && c <= 'Z' ? std::string(" ") + static_cast<char>(c - 'A' + 'a') : std::string(1, c);
  return words;
}

/// "min 0.5, median 1.5": the members of an object that are set, and of lists the first ones.
std::string textOf(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_number()) return value.dump();
  std::string text;
  size_t count = 0;
  for (const auto& [key, member] : value.items()) {
    if (member.is_null() || (member.is_number_float() && !std::isfinite(member.get<double>()))) continue;
    if (value.is_array() && count == kMaxListedItems) return text + fmt::format("; {} in all", value.size());
    text += fmt::format("{}{}{}",
                        count++ == 0       ? ""
                        : value.is_array() ? "; "
                                           : ", ",
                        value.is_array() ? "" : wordsOf(key) + " ", textOf(member));
  }
  return text;
}

}  // namespace

std::string groupedCount(uint64_t count, const char* singular, const char* plural) {
  if (count != 1 && plural != nullptr) return fmt::format("{} {}", groupDigits(count), plural);
  return fmt::format("{} {}{}", groupDigits(count), singular, count == 1 ? "" : "s");
}

ReportRows reportRows(const Report& report) {
  ReportRows rows = report.thickness ? thicknessRows(report) : shortRows(report);
  if (report.thickness) rows.emplace_back("mesh", meshRow(report));
  Json json = toJson(report);
  for (Json& seconds : json.at("stageSeconds"))
    if (seconds == 0.0) seconds = nullptr;  // The stage did not run.
  for (const auto& [key, value] : json.items()) {
    // The thickness has its own rows, and warnings and defects are lines of their own.
    if (key == "thickness" || key == "warnings" || key == "defects" || value.is_null() || value == 0) continue;
    if (key == "solver" && report.solver.name.empty()) continue;  // Nothing was interpolated.
    if (std::string text = textOf(value); !text.empty()) rows.emplace_back(wordsOf(key), std::move(text));
  }
  return rows;
}

std::string textReport(const MeshOutcome& outcome) {
  ReportRows rows = outcome.outputs.verbose ? reportRows(outcome.result.report) : shortRows(outcome.result.report);
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
  if (warning.code == WarningCode::UncertainParts) text += "; look at them, and choose --parts N or --detail X";
  if (warning.code == WarningCode::CoarseParts) text += "; subdivide or remesh the mesh";
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
  if (session.backend() == "vulkan" && session.runsOnCpu())
    lines.front() += "; a CPU device: --backend cpu may be faster";
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
