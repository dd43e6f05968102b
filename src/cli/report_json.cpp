#include "cli/report_json.h"

#include "core/json.h"
#include "describe/report_json.h"
#include "describe/report_text.h"

namespace asdfvk {

namespace {

std::string oneLineOf(const Json& json) { return jsonText(json) + "\n"; }

}  // namespace

std::string jsonReport(const MeshOutcome& outcome) {
  const auto orNull = [](const std::string& path) { return path.empty() ? Json(nullptr) : Json(path); };
  Json json{{"mesh", outcome.mesh},
            {"output", orNull(outcome.output)},
            {"picture", orNull(outcome.outputs.picture)},
            {"points", orNull(outcome.outputs.points)},
            {"with", outcome.others.with},
            {"withFaceCounts", outcome.withFaceCounts},
            {"former", orNull(outcome.others.former)}};
  Report report = outcome.result.report;
  for (Warning& warning : report.warnings) warning.message = textWarning(warning, OptionSpelling::Flag);
  json.update(resultJson(report, outcome.result.fields, outcome.computation, outcome.session));
  return oneLineOf(json);
}

std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message) {
  return oneLineOf({{"formatVersion", kReportFormatVersion},
                    {"mesh", mesh.empty() ? Json(nullptr) : Json(mesh)},
                    {"error", message},
                    {"code", code}});
}

std::string jsonSkipped(const std::string& mesh, const MeshRecord& record) {
  return oneLineOf({{"formatVersion", kReportFormatVersion},
                    {"mesh", mesh},
                    {"output", record.output},
                    {"status", record.status},
                    {"record", toJson(record)}});
}

}  // namespace asdfvk
