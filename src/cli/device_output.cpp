#include "cli/device_output.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/choices.h"
#include "asdf_vk/version.h"
#include "cli/device_documents.h"
#include "core/text.h"
#include "describe/report_text.h"
#include "process/interrupt.h"
#include "process/terminal.h"

namespace asdfvk {

namespace {

std::string versionText(uint32_t packed) {
  return fmt::format("{}.{}.{}", (packed >> 22) & 0x7f, (packed >> 12) & 0x3ff, packed & 0xfff);
}

TracerReport withRoundedRates(TracerReport tracer) {
  tracer.raysPerSecond = std::round(tracer.raysPerSecond);
  tracer.kernelRaysPerSecond = std::round(tracer.kernelRaysPerSecond);
  return tracer;
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
  DeviceList list{.devices = {}, .reason = reason};
  for (const DeviceInfo& device : devices)
    list.devices.push_back(
        {list.devices.size(), device.name, device.driver, device.kind, device.usable, device.reason});
  return jsonText(list) + "\n";
}

std::string jsonDeviceReport(const DeviceReport& report) {
  DeviceReportDocument document{.version = ASDFVK_VERSION,
                                .commit = ASDFVK_COMMIT,
                                .passed = report.passed(),
                                .reason = report.failure ? report.failure->what() : "",
                                .devices = report.deviceLines,
                                .device = {},
                                .defaults = {},
                                .mesh = {report.faceCount, report.rayCount},
                                .fastest = {},
                                .tracers = {},
                                .solvers = report.solvers};
  if (const std::optional<DeviceFacts>& device = report.device) {
    document.device = TestedDevice{device->name, std::string(toString(device->kind)), device->driver,
                                   versionText(device->apiVersion), device->subgroupSize};
    document.defaults = DeviceDefaults{report.choice.variant(), report.defaultSolver};
  }
  if (const TracerReport* const fastest = report.fastest()) document.fastest = withRoundedRates(*fastest);
  for (const TracerReport& tracer : report.tracers) document.tracers.push_back(withRoundedRates(tracer));
  return jsonText(document, 2) + "\n";
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
