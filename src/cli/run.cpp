#include "cli/run.h"

#include <optional>
#include <string>

#include "cli/interrupt.h"
#include "cli/output_plan.h"
#include "cli/picture_output.h"
#include "cli/progress.h"
#include "cli/report_json.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "io/mesh_reader.h"
#include "io/result_writer.h"
#include "pipeline/asdf.h"

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

/// What a mesh leaves behind: its exit code and its line for --json.
struct Answer {
  ExitCode code = ExitCode::Done;
  std::string json;
};

Answer runMesh(Session& session, const std::string& name, const std::string& output, const CommandLine& line,
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
    const Stopwatch writeWatch;
    writeResult(output, mesh, {result.sdf, result.isSeed}, writeOptionsOf(line));
    result.report.stageSeconds.write = writeWatch.seconds();
    if (!line.picture.empty())
      runWithProgress(line, stop, [&](const RunControl& control) { writePicture(line, mesh, result, control); });
  }
  result.report.stageSeconds.read = readSeconds;

  const MeshOutcome outcome{name, output, line, result.report};
  if (!line.quiet) {
    for (const std::string& warning : result.report.warnings) printWarning(name, warning);
    writeStandardError(textReport(outcome));
  }
  Answer answer{ExitCode::Done, jsonReport(outcome)};
  if (result.report.check) answer.code = exitCodeOf(*result.report.check);
  if (answer.code != ExitCode::Done) printError(name, checkFailure(*result.report.check));
  return answer;
}

/// Runs `step`, which gives an Answer; whatever it throws becomes one, told as an error of the mesh.
template <typename Step>
Answer answerOf(const std::string& mesh, Step step) {
  try {
    return step();
  } catch (...) {
    Failure failure = currentFailure();
    const std::string prefix = mesh + ": ";  // Readers name the file themselves.
    if (failure.message.starts_with(prefix)) failure.message.erase(0, prefix.size());
    printError(mesh, failure.message);
    return {failure.code, jsonFailure(mesh, failure.message)};
  }
}

ExitCode failWithoutSession(const CommandLine& line) {
  const Failure failure = currentFailure();
  printError("", failure.message);
  for (const std::string& mesh : line.meshes)
    if (line.json) writeStandardOutput(jsonFailure(mesh, failure.message));
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
  if (!line.quiet)
    for (const std::string& device : session->deviceLines()) writeStandardError(oneLine("asdf-vk: " + device) + "\n");

  ExitCode first = ExitCode::Done;
  for (size_t i = 0; i < line.meshes.size(); ++i) {
    const std::string& mesh = line.meshes[i];
    const Answer answer = answerOf(mesh, [&] { return runMesh(*session, mesh, outputs[i], line, stop); });
    if (first == ExitCode::Done) first = answer.code;
    if (line.json) writeStandardOutput(answer.json);
    if (answer.code == ExitCode::Cancelled) break;
  }
  return first;
}

void printDevices(const CommandLine& line) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason);
  writeStandardOutput(line.json ? jsonDevices(devices, reason) : textDevices(devices, reason));
}

}  // namespace asdfvk
