#include "cli/report.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "asdf_vk/version.h"
#include "core/json.h"
#include "diagnose/device_report.h"
#include "process/interrupt.h"
#include "process/terminal.h"

namespace asdfvk {

void to_json(Json& json, const TracerReport& tracer) {
  json = {{"backend", tracer.backend},
          {"variant", tracer.variant},
          {"isDefault", tracer.isDefault},
          {"passed", tracer.passed},
          {"refusal", tracer.refusal},
          {"failure", tracer.failure},
          {"comparedCount", tracer.comparedCount},
          {"differingCount", tracer.differingCount},
          {"raysPerSecond", std::round(tracer.raysPerSecond)}};
}
ASDFVK_JSON(SolverCheckReport, name, passed, refusal, failure, unknownCount, iterations, finishedOnCpu, difference,
            seconds)
ASDFVK_JSON(DeviceInfo, name, driver, kind, usable, reason)

namespace {

std::string oneLineOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

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

Json defaultsOf(const DeviceReport& report) {
  return {{"variant", report.choice.variant()}, {"solver", report.defaultSolver}};
}

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
  return oneLineOf({{"mesh", mesh}, {"error", message}, {"code", code}});
}

std::string jsonSkipped(const std::string& mesh, const MeshRecord& record) {
  return oneLineOf({{"mesh", mesh}, {"output", record.output}, {"status", record.status}, {"record", toJson(record)}});
}

std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason) {
  Json list = Json::array();
  for (const DeviceInfo& device : devices) {
    list.push_back({{"index", list.size()}});
    list.back().update(Json(device));
  }
  return oneLineOf({{"devices", list}, {"reason", reason}});
}

std::string jsonDeviceReport(const DeviceReport& report) {
  const TracerReport* const fastest = report.fastest();
  const Json json{{"version", ASDFVK_VERSION},
                  {"commit", ASDFVK_COMMIT},
                  {"passed", report.passed()},
                  {"reason", report.failure ? report.failure->what() : ""},
                  {"devices", report.deviceLines},
                  {"device", report.device ? deviceOf(*report.device) : Json(nullptr)},
                  {"defaults", report.device ? defaultsOf(report) : Json(nullptr)},
                  {"mesh", {{"faceCount", report.faceCount}, {"raysPerCone", report.rayCount}}},
                  {"fastest", fastest == nullptr ? Json(nullptr) : Json(*fastest)},
                  {"tracers", report.tracers},
                  {"solvers", report.solvers}};
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
