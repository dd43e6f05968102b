#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "cli/report.h"
#include "core/text.h"

namespace asdfvk {
namespace {

/// Replaces the rows of the checks of the space that were requested by their verdicts.
void addSpaceVerdicts(const ComputationSettings& computation, const Report& report, ReportRows& rows) {
  const auto voids = std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.first == "voids"; });
  if (voids == rows.end()) return;
  if (computation.failsIfVoids) voids->second = voidsVerdict(report).second;
  if (!computation.failsIfContact) return;
  const auto contact = std::next(voids);
  const std::string sentence = contactVerdict(report).second;
  if (contact != rows.end() && contact->first == "contact")
    contact->second = sentence;
  else
    rows.insert(contact, {"contact", sentence});
}

}  // namespace

std::string textReport(const MeshOutcome& outcome) {
  const Report& report = outcome.result.report;
  ReportRows rows = outcome.outputs.verbose ? reportRows(report, OptionSpelling::Flag)
                                            : shortReportRows(report, OptionSpelling::Flag);
  addSpaceVerdicts(outcome.computation, report, rows);
  const auto placeText = [](const std::string& place) { return place == "-" ? "standard output" : place; };
  std::vector<std::string> files;
  if (!outcome.output.empty()) files.push_back(placeText(outcome.output));
  if (!outcome.outputs.points.empty()) files.push_back("points " + placeText(outcome.outputs.points));
  if (!outcome.outputs.picture.empty()) files.push_back("picture " + placeText(outcome.outputs.picture));
  if (!files.empty()) rows.emplace_back("output", joined(files, ", "));
  std::string text = fmt::format("{}: {}\n", outcome.mesh, rows.front().second);
  for (size_t i = 1; i < rows.size(); ++i) text += fmt::format("  {:<9} {}\n", rows[i].first, rows[i].second);
  return text;
}

std::string deviceLinesOf(const Session& session, const SessionOptions& options, bool isVerbose) {
  std::vector<std::string> lines = session.deviceLines();
  const bool isReplaced =
      options.backend == BackendChoice::Automatic && session.backend() != nameOf(kBackendNames, BackendChoice::Vulkan);
  const bool isOtherPossible = options.device.empty() && session.runsOnCpu() && lines.size() > 1;
  if (!isVerbose && !isReplaced && !isOtherPossible) return {};
  if (session.backend() == nameOf(kBackendNames, BackendChoice::Vulkan) && session.runsOnCpu())
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
