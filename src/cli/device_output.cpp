#include "cli/device_output.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/choices.h"
#include "asdf_vk/version.h"
#include "core/json.h"
#include "core/text.h"
#include "describe/report_json.h"
#include "describe/report_text.h"
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
          {"raysPerSecond", std::round(tracer.raysPerSecond)},
          {"kernelRaysPerSecond", std::round(tracer.kernelRaysPerSecond)}};
}
ASDFVK_JSON(SolverCheckReport, name, passed, refusal, failure, unknownCount, iterations, finishedOnCpu, difference,
            seconds)
ASDFVK_JSON(DeviceInfo, name, driver, kind, usable, reason)

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

Json defaultsOf(const DeviceReport& report) {
  return {{"variant", report.choice.variant()}, {"solver", report.defaultSolver}};
}

}  // namespace

std::string deviceLinesOf(const Session& session, const SessionOptions& options, bool isVerbose) {
  std::vector<std::string> lines = session.deviceLines();
  const bool isReplaced =
      options.backend == BackendChoice::Automatic && session.backend() != nameOf(kBackendNames, BackendChoice::Vulkan);
  const bool isOtherPossible = options.device.empty() && session.runsOnCpu() && lines.size() > 1;
  if (!isVerbose && !isReplaced && !isOtherPossible) return {};
  if (session.backend() == nameOf(kBackendNames, BackendChoice::Vulkan) && session.runsOnCpu())
    lines.front() += "; a CPU device: --backend cpu is faster";
  std::string text;
  for (const std::string& line : lines) text += oneLine("asdf-vk: " + line) + "\n";
  return text;
}

std::string deviceChoiceLine(const Report& report, bool isVerbose) {
  if (!report.leastRaysForGpu || (!isVerbose && !report.runsOnCpu)) return {};
  return fmt::format("asdf-vk: {}: {}: {}\n", report.backend, report.device,
                     backendReason(report, OptionSpelling::Flag));
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

std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason) {
  Json list = Json::array();
  for (const DeviceInfo& device : devices) {
    list.push_back({{"index", list.size()}});
    list.back().update(Json(device));
  }
  return jsonText({{"devices", list}, {"reason", reason}}) + "\n";
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
  return jsonText(json, 2) + "\n";
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
