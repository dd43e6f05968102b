#include "cli/report.h"

#include <fmt/core.h>

#include <cmath>
#include <type_traits>
#include <utility>

#include "asdf_vk/version.h"
#include "core/json.h"
#include "describe/report_keys.h"
#include "diagnose/device_report.h"
#include "process/interrupt.h"
#include "process/terminal.h"

namespace asdfvk {
namespace {

std::string oneLineOf(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// {"name": "sdf", "unit": "length", "per": "face", "components": 1, "type": "float64", "min": ...}
Json fieldOf(const Field& field) {
  constexpr const char* kTypes[]{"float64", "uint8", "uint32"};
  const FieldSummary summary = summarize(field);
  return {{"name", field.name},
          {"unit", field.unit},
          {"per", field.location == FieldLocation::PerFace ? "face" : "vertex"},
          {"components", field.componentCount},
          {"type", kTypes[field.values.index()]},
          {"min", number(summary.min)},
          {"median", number(summary.median)},
          {"max", number(summary.max)},
          {"missingCount", summary.missingCount}};
}

Json jsonOf(double value) { return number(value); }
Json jsonOf(const std::string& text) { return text; }
Json jsonOf(const Vec3d& point) { return arrayOf(point); }
Json jsonOf(WarningCode code) { return nameOf(code); }
Json jsonOf(ThicknessVerdict verdict) { return nameOf(verdict); }

Json jsonOf(const StageSeconds& seconds) {
  Json json;
  for (size_t i = 0; i < kStageCount; ++i) json[nameOf(static_cast<Stage>(i))] = number(seconds.seconds[i]);
  return json;
}

Json jsonOf(const std::vector<ErrorDetail>& details) {
  Json json = Json::object();
  for (const ErrorDetail& detail : details) json[detail.name] = detail.value;
  return json;
}

template <typename T>
Json jsonOf(const T& value);

template <typename T>
Json jsonOf(const std::optional<T>& value) {
  return value ? jsonOf(*value) : Json(nullptr);
}

template <typename T>
Json jsonOf(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(jsonOf(item));
  return list;
}

/// Numbers and flags, and an object of the members of a structure of the report.
template <typename T>
Json jsonOf(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    return value;
  } else {
    Json json = Json::object();
    visitKeys(value, [&](const std::string& key, const auto& member) { json[key] = jsonOf(member); });
    return json;
  }
}

std::string versionText(uint32_t packed) {
  return fmt::format("{}.{}.{}", (packed >> 22) & 0x7f, (packed >> 12) & 0x3ff, packed & 0xfff);
}

Json deviceOf(const DeviceFacts& device) {
  return {{"name", device.name},
          {"kind", toString(device.kind)},
          {"driver", device.driver},
          {"apiVersion", versionText(device.apiVersion)},
          {"subgroupSize", device.subgroupSize}};
}

Json variantJson(const TraceVariant& variant) { return {{"kernel", variant.kernel}, {"fetch", variant.fetch}}; }

Json defaultsOf(const DeviceReport& report) {
  Json json = variantJson(variantOf(report.choice));
  json["reason"] = defaultTraceReason(*report.device);
  json["solver"] = report.defaultSolver;
  return json;
}

/// null: not run, because the device excludes it.
template <typename Report>
Json passedOf(const Report& report) {
  return report.refusal.empty() ? Json(report.passed) : Json(nullptr);
}

template <typename Report>
std::string reasonOf(const Report& report) {
  return report.refusal.empty() ? report.failure : report.refusal;
}

Json tracerOf(const TracerReport& tracer) {
  Json json{{"backend", tracer.backend}};
  if (tracer.variant) json.update(variantJson(*tracer.variant));
  json["default"] = tracer.isDefault;
  json["passed"] = passedOf(tracer);
  json["reason"] = reasonOf(tracer);
  json["comparedCount"] = tracer.comparedCount;
  json["differingCount"] = tracer.differingCount;
  json["raysPerSecond"] = number(std::round(tracer.raysPerSecond));
  return json;
}

Json solverOf(const SolverCheckReport& solver) {
  return {{"name", solver.name},
          {"passed", passedOf(solver)},
          {"reason", reasonOf(solver)},
          {"unknownCount", solver.unknownCount},
          {"iterations", solver.iterations},
          {"finishedOnCpu", solver.finishedOnCpu},
          {"difference", number(solver.difference)},
          {"seconds", number(solver.seconds)}};
}

Json fastestOf(const DeviceReport& report) {
  const TracerReport* fastest = report.fastest();
  if (fastest == nullptr) return nullptr;
  Json json = variantJson(*fastest->variant);
  json["default"] = fastest->isDefault;
  return json;
}

}  // namespace

std::string jsonReport(const MeshOutcome& outcome) {
  Json json;
  json["mesh"] = outcome.mesh;
  json["output"] = outcome.output;
  json["picture"] = outcome.outputs.picture.empty() ? Json(nullptr) : Json(outcome.outputs.picture);
  json["points"] = outcome.outputs.points.empty() ? Json(nullptr) : Json(outcome.outputs.points);
  Report report = outcome.result.report;
  for (Warning& warning : report.warnings) warning.message = textWarning(warning);
  json.update(jsonOf(report));
  json["fields"] = Json::array();
  for (const Field& field : outcome.result.fields) json["fields"].push_back(fieldOf(field));
  json["version"] = ASDFVK_VERSION;
  json["commit"] = ASDFVK_COMMIT;
  json["options"] = optionValues(outcome.computation, outcome.session);
  return oneLineOf(json);
}

Json toJson(const ErrorEstimate& estimate) { return jsonOf(estimate); }

std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message) {
  Json json;
  json["mesh"] = mesh;
  json["error"] = message;
  json["code"] = code;
  return oneLineOf(json);
}

std::string jsonSkipped(const std::string& mesh, const MeshRecord& record) {
  Json json;
  json["mesh"] = mesh;
  json["output"] = record.output ? Json(*record.output) : Json(nullptr);
  json["status"] = nameOf(record.status);
  json["record"] = toJson(record);
  return oneLineOf(json);
}

std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason) {
  Json list = Json::array();
  for (size_t i = 0; i < devices.size(); ++i)
    list.push_back({{"index", i},
                    {"name", devices[i].name},
                    {"driver", devices[i].driver},
                    {"kind", devices[i].kind},
                    {"usable", devices[i].usable},
                    {"reason", devices[i].reason}});
  Json json;
  json["devices"] = std::move(list);
  json["reason"] = reason;
  return oneLineOf(json);
}

std::string jsonDeviceReport(const DeviceReport& report) {
  Json json;
  json["version"] = ASDFVK_VERSION;
  json["commit"] = ASDFVK_COMMIT;
  json["passed"] = report.passed();
  json["reason"] = report.failure ? report.failure->what() : "";
  json["devices"] = report.deviceLines;
  if (report.device) {
    json["device"] = deviceOf(*report.device);
    json["defaults"] = defaultsOf(report);
  } else {
    json["device"] = nullptr;
  }
  json["mesh"] = {{"faceCount", report.faceCount}, {"raysPerCone", report.rayCount}};
  json["fastest"] = fastestOf(report);
  json["tracers"] = Json::array();
  for (const TracerReport& tracer : report.tracers) json["tracers"].push_back(tracerOf(tracer));
  json["solvers"] = Json::array();
  for (const SolverCheckReport& solver : report.solvers) json["solvers"].push_back(solverOf(solver));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ExitCode printDeviceReport(const SessionOptions& session, const std::stop_token& stop) {
  DeviceReport report;
  {
    const Interrupt::Listening listening;
    RunControl control;
    control.stop = stop;
    report = reportDevice(session, control);
  }
  writeStandardOutput(jsonDeviceReport(report));
  if (report.passed()) return ExitCode::Done;
  if (report.failure) throw *report.failure;
  printError("", "the self-test of the device failed; see the report");
  return ExitCode::Device;
}

}  // namespace asdfvk
