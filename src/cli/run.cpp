#include "cli/run.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/asdf_vk.h"
#include "cli/interrupt.h"
#include "cli/output_plan.h"
#include "cli/picture_output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "mesh/orientation.h"

namespace asdfvk {
namespace {

/// Runs `work`, which takes a RunControl, with a bar on a terminal.
template <typename Work>
auto runWithProgress(const CommandLine& line, const std::stop_token& stop, const Work& work) {
  const Stopwatch watch;
  std::optional<ProgressBar> bar;
  if (!line.quiet && isStandardErrorTerminal()) bar.emplace(writeStandardError, [&watch] { return watch.seconds(); });
  RunControl control;
  control.stop = stop;
  if (bar) control.progress = [&bar](double fraction) { bar->update(fraction); };
  return work(control);
}

/// Exit code of a mesh and its line for --json.
struct MeshReport {
  ExitCode code = ExitCode::Done;
  std::string json;
};

MeshReport runMesh(Session& session, const std::string& name, const std::string& output, const CommandLine& line,
                   const std::stop_token& stop) {
  requireWritablePlace(output);
  if (!line.picture.empty()) requireWritablePlace(line.picture);
  const Stopwatch readWatch;
  Mesh mesh = readMesh(name);
  const double readSeconds = readWatch.seconds();

  Result result;
  {
    const Interrupt::Listening listening;
    result = runWithProgress(line, stop,
                             [&](const RunControl& control) { return session.compute(mesh, line.options, control); });
    if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
    StageSeconds& seconds = result.report.stageSeconds;
    const Stopwatch writeWatch;
    flipInputFaces(mesh, result.report.reversedFaces);  // The scene of the result has its own copy.
    writeResult(output, mesh, result.fields, writeOptionsOf(line));
    seconds[Stage::Write] = writeWatch.seconds();
    seconds[Stage::Read] = readSeconds;
    if (!line.picture.empty())
      runWithProgress(line, stop, [&](const RunControl& control) { writePicture(line, result, control); });
  }

  const MeshOutcome outcome{name, output, line, result};
  if (!line.quiet) {
    for (const Warning& warning : result.report.warnings) printWarning(name, textWarning(warning));
    writeStandardError(textReport(outcome));
  }
  MeshReport report{ExitCode::Done, jsonReport(outcome)};
  if (result.report.check) report.code = exitCodeOf(*result.report.check);
  if (report.code != ExitCode::Done) printError(name, checkFailure(*result.report.check));
  return report;
}

/// Runs `step`, which returns a MeshReport; an exception becomes one and is printed as an error of the mesh.
template <typename Step>
MeshReport reportOf(const std::string& mesh, Step step) {
  try {
    return step();
  } catch (...) {
    Failure failure = currentFailure();
    const std::string prefix = mesh + ": ";  // Readers name the file, too.
    if (failure.message.starts_with(prefix)) failure.message.erase(0, prefix.size());
    printError(mesh, failure.message);
    return {failure.code, jsonFailure(mesh, failure.name, failure.message)};
  }
}

void printDeviceLines(const Session& session) {
  std::vector<std::string> lines = session.deviceLines();
  if (session.backend() == "vulkan" && session.runsOnCpu() && isBackendBuilt("cpu"))
    lines.front() += "; a CPU device: --backend cpu (Embree) may be faster";
  for (const std::string& line : lines) writeStandardError(oneLine("asdf-vk: " + line) + "\n");
}

ExitCode failWithoutSession(const CommandLine& line) {
  const Failure failure = currentFailure();
  printError("", failure.message);
  for (const std::string& mesh : line.meshes)
    if (line.json) writeStandardOutput(jsonFailure(mesh, failure.name, failure.message));
  return failure.code;
}

}  // namespace

ExitCode runMeshes(const CommandLine& line, const std::stop_token& stop) {
  const std::vector<std::string> outputs = planOutputs(line);
  std::optional<Session> session;
  try {
    session.emplace(line.session);
  } catch (...) {
    return failWithoutSession(line);
  }
  if (!line.quiet) printDeviceLines(*session);

  ExitCode first = ExitCode::Done;
  for (size_t i = 0; i < line.meshes.size(); ++i) {
    const std::string& mesh = line.meshes[i];
    const MeshReport report = reportOf(mesh, [&] { return runMesh(*session, mesh, outputs[i], line, stop); });
    if (first == ExitCode::Done) first = report.code;
    if (line.json) writeStandardOutput(report.json);
    if (report.code == ExitCode::Cancelled) break;
  }
  return first;
}

void printDevices(const CommandLine& line) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason);
  writeStandardOutput(line.json ? jsonDevices(devices, reason) : textDevices(devices, reason));
}

}  // namespace asdfvk
