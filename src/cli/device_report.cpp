#include "diagnose/device_report.h"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "asdf_vk/version.h"
#include "cli/report.h"
#include "core/json.h"
#include "process/interrupt.h"
#include "process/terminal.h"

namespace asdfvk {
namespace {

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

Json variantJson(const TraceVariant& variant) {
  return {{"kernel", variant.kernel}, {"bvh", variant.bvh}, {"fetch", variant.fetch}};
}

Json defaultsOf(const DeviceReport& report) {
  Json json = variantJson(variantOf(report.choice));
  json["reason"] = defaultTraceReason(*report.device);
  json["solver"] = report.defaultSolver;
  json["lanesPerCone"] = report.workgroups.lanesPerCone;
  json["conesPerWorkgroup"] = report.workgroups.conesPerWorkgroup;
  json["iterationLimit"] = report.workgroups.iterationLimit;
  json["wideStackSize"] = report.walk.wideStackSize;
  json["binaryStackSize"] = report.walk.binaryStackSize;
  json["postponesTriangles"] = report.walk.postponesTriangles;
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
