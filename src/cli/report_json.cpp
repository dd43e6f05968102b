#include "cli/report_json.h"

#include "describe/report_json.h"
#include "describe/report_text.h"

namespace asdfvk {

namespace {

std::optional<std::string> orNull(const std::string& path) { return path.empty() ? std::nullopt : std::optional(path); }
std::string oneLineOf(const Json& json) { return jsonText(json) + "\n"; }

}  // namespace

std::string jsonReport(const MeshOutcome& outcome) {
  Json json = ReportFiles{
      outcome.mesh,        orNull(outcome.output), orNull(outcome.outputs.picture), orNull(outcome.outputs.points),
      outcome.others.with, outcome.withFaceCounts, orNull(outcome.others.former)};
  Report report = outcome.result.report;
  for (Warning& warning : report.warnings) warning.message = textWarning(warning, OptionSpelling::Flag);
  json.update(resultJson(report, outcome.result.fields, outcome.computation, outcome.session));
  return oneLineOf(json);
}

std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message) {
  return oneLineOf(FailureDocument{.mesh = orNull(mesh), .error = message, .code = code});
}

std::string jsonSkipped(const std::string& mesh, const MeshRecord& record) {
  return oneLineOf(
      SkippedDocument{.mesh = mesh, .output = record.output, .status = record.status, .record = toJson(record)});
}

}  // namespace asdfvk
