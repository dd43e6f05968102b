#include "cli/run.h"

#include <optional>
#include <string>

#include "cli/interrupt.h"
#include "cli/output_plan.h"
#include "cli/progress.h"
#include "cli/report_json.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "mesh/mesh_reader.h"
#include "mesh/result_writer.h"
#include "pipeline/asdf.h"

namespace asdfvk {
namespace {

void writeTo(const std::string& output, const CommandLine& line, const Mesh& mesh, const Result& result) {
  const FaceValues values{result.sdf, result.isSeed};
  const WriteOptions options{.ascii = line.ascii};
  if (output == "-")
    writeResultToStandardOutput(line.format.empty() ? "ply" : line.format, mesh, values, options);
  else
    writeResult(output, mesh, values, options);
}

Result computeMesh(Session& session, const Mesh& mesh, const CommandLine& line, const std::stop_token& stop) {
  const Stopwatch watch;
  std::optional<ProgressBar> bar;
  if (!line.quiet && isStandardErrorTerminal()) bar.emplace(writeStandardError, [&watch] { return watch.seconds(); });
  RunControl control;
  control.stop = stop;
  if (bar) control.progress = [&bar](double fraction) { bar->update(fraction); };
  return session.compute(mesh, line.options, control);
}

/// Everything about one mesh. Returns Done or CheckFailed; every other failure is thrown.
ExitCode runMesh(Session& session, const std::string& name, const std::string& output, const CommandLine& line,
                 const std::stop_token& stop) {
  requireWritablePlace(output);
  const Stopwatch readWatch;
  const Mesh mesh = readMesh(name);
  const double readSeconds = readWatch.seconds();

  Result result;
  {
    const Interrupt::Listening listening;
    result = computeMesh(session, mesh, line, stop);
    if (stop.stop_requested()) throw Error(ErrorKind::Cancelled, "cancelled");
    const Stopwatch writeWatch;
    writeTo(output, line, mesh, result);
    result.report.stageSeconds.write = writeWatch.seconds();
  }
  result.report.stageSeconds.read = readSeconds;

  const MeshOutcome outcome{name, output, line, result.report};
  if (!line.quiet) {
    for (const std::string& warning : result.report.warnings) printWarning(name, warning);
    writeStandardError(textReport(outcome));
  }
  if (line.json) writeStandardOutput(jsonReport(outcome));
  if (!result.report.check || hasPassed(*result.report.check)) return ExitCode::Done;
  printError(name, checkFailure(*result.report.check));
  return ExitCode::CheckFailed;
}

/// Readers name the file themselves.
std::string withoutName(const std::string& message, const std::string& name) {
  const std::string prefix = name + ": ";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

void reportFailure(const std::string& mesh, const std::string& message, bool json) {
  const std::string reason = withoutName(message, mesh);
  printError(mesh, reason);
  if (json) writeStandardOutput(jsonFailure(mesh, reason));
}

}  // namespace

ExitCode runMeshes(const CommandLine& line, const std::stop_token& stop) {
  const std::vector<std::string> outputs = planOutputs(line);
  std::optional<Session> session;
  try {
    session.emplace(line.session);
  } catch (...) {
    const Failure failure = currentFailure();
    printError("", failure.message);
    for (const std::string& mesh : line.meshes)
      if (line.json) writeStandardOutput(jsonFailure(mesh, failure.message));
    return failure.code;
  }
  if (!line.quiet) writeStandardError(oneLine("asdf-vk: " + session->deviceLine()) + "\n");

  ExitCode first = ExitCode::Done;
  for (size_t i = 0; i < line.meshes.size(); ++i) {
    ExitCode code = ExitCode::Done;
    try {
      code = runMesh(*session, line.meshes[i], outputs[i], line, stop);
    } catch (...) {
      const Failure failure = currentFailure();
      code = failure.code;
      reportFailure(line.meshes[i], failure.message, line.json);
    }
    if (first == ExitCode::Done) first = code;
    if (code == ExitCode::Cancelled) break;
  }
  return first;
}

void printDevices(const CommandLine& line) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason);
  writeStandardOutput(line.json ? jsonDevices(devices, reason) : textDevices(devices, reason));
}

}  // namespace asdfvk
