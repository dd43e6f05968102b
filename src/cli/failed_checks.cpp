#include "cli/failed_checks.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

#include "describe/report_text.h"
#include "describe/thickness_text.h"
#include "describe/unjudged_text.h"

namespace asdfvk {
namespace {

/// Whether a baseline has all that fails this check.
bool isKnown(const Failure& failure, const Report& report) {
  using Kind = FindingKind;
  if (failure.code != ExitCode::OverLimit || knownCountOf(report) == 0) return false;
  return std::none_of(report.findings.begin(), report.findings.end(), [&](const Finding& finding) {
    if (finding.level != FindingLevel::Failure) return false;
    const bool isThin = finding.kind == Kind::ThinDetail || finding.kind == Kind::ThinEdge;
    if (failure.name == "tooThin") return isThin || finding.kind == Kind::ThinWall;
    if (failure.name == "tooClose") return isThin || finding.kind == Kind::NarrowGap;
    return finding.kind == (failure.name == "tooThick"      ? Kind::ThickBody
                            : failure.name == "sealedVoids" ? Kind::SealedVoid
                                                            : Kind::BodiesInContact);
  });
}

}  // namespace

size_t knownCountOf(const Report& report) {
  return static_cast<size_t>(std::count_if(report.findings.begin(), report.findings.end(),
                                           [](const Finding& finding) { return finding.isKnown; }));
}

std::vector<Failure> failedChecks(const ComputationSettings& computation, const Report& report) {
  std::vector<Failure> failures;
  if (report.check && exitCodeOf(*report.check) != ExitCode::Done)
    failures.push_back({ExitCode::CheckFailed, checkFailure(*report.check), "checkFailed"});
  std::vector<Failure> notJudged;  // A failure is more certain, and determines the exit code.
  const auto add = [&](ThicknessVerdict verdict, std::string message, const UnjudgedFaces& unjudged, const char* name) {
    if (verdict == ThicknessVerdict::Passed) return;
    const bool isFailed = verdict == ThicknessVerdict::Failed;
    const ReportRows reasons = shortUnjudgedRows(unjudged, OptionSpelling::Flag);
    if (!isFailed && !reasons.empty()) message += fmt::format("; {} {}", reasons[0].first, reasons[0].second);
    if (isFailed)
      failures.push_back({ExitCode::OverLimit, message, name});
    else
      notJudged.push_back({ExitCode::CheckFailed, message, "notJudged"});
  };
  if (computation.failIfThinner && report.comparison)
    add(*report.comparison->verdict, report.comparison->sentence, report.thickness->unjudged, "tooThin");
  else if (computation.failIfThinner)
    add(*report.thickness->verdict, report.thickness->sentence, report.thickness->unjudged, "tooThin");
  if (computation.failIfThicker)
    add(report.thickness->thick->verdict, report.thickness->thick->sentence, report.thickness->unjudged, "tooThick");
  if (computation.failIfCloser) add(*report.gap->verdict, report.gap->sentence, report.gap->unjudged, "tooClose");
  if (computation.failsIfVoids) {
    const auto [verdict, sentence] = voidsVerdict(report);
    add(verdict, sentence, report.gap->unjudged, "sealedVoids");
  }
  if (computation.failsIfContact) {
    const auto [verdict, sentence] = contactVerdict(report);
    add(verdict, sentence, report.gap->unjudged, "bodiesInContact");
  }
  failures.insert(failures.end(), notJudged.begin(), notJudged.end());
  std::erase_if(failures, [&](const Failure& failure) { return isKnown(failure, report); });
  return failures;
}

}  // namespace asdfvk
