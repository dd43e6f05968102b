#include "cli/run.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/asdf_vk.h"
#include "cli/browser.h"
#include "cli/interrupt.h"
#include "cli/output_plan.h"
#include "cli/page_output.h"
#include "cli/report.h"
#include "cli/result_picture.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "mesh/orientation.h"
#include "render/png.h"

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

/// Renders the field of --picture-of and writes it atomically. Precondition: result.scene is set. Throws
/// Error{OutputNotWritable}, Error{UnknownField} and Error{Cancelled}.
void writePicture(const CommandLine& line, const Result& result, const RunControl& control) {
  const Field* field = result.field(line.pictureOf);
  if (field == nullptr) throw Error(ErrorCode::UnknownField, "--picture-of: the result has no field " + line.pictureOf);
  if (field->componentCount != 1)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("--picture-of: field {} has {} components; a picture shows a field of one component",
                            line.pictureOf, field->componentCount));
  writePng(line.picture, pictureOf(result, *field, line.pictureView, {}, control));
}

/// The page of one or several results.
struct SharedPage {
  Page page = emptyPage();
  size_t awaitedCount = 0;  ///< Results that are not computed yet.
  bool isFinished = false;
};

/// Also starts the browser with --open.
void finishPage(const std::string& output, SharedPage& shared, const CommandLine& line) {
  shared.isFinished = true;
  writePage(output, shared.page);
  if (line.opensPage) openInBrowser(output);
}

/// Writes the result, or adds it to the page, which is written with its last result.
void writeOutput(const MeshOutcome& outcome, const Mesh& mesh, SharedPage* page, const std::stop_token& stop) {
  const CommandLine& line = outcome.line;
  if (page == nullptr) {
    writeResult(outcome.output, mesh, writableFields(line, outcome.output, outcome.result.fields),
                writeOptionsOf(line));
    return;
  }
  runWithProgress(line, stop, [&](const RunControl& control) { addToPage(page->page, outcome, control); });
  if (page->awaitedCount == 1) finishPage(outcome.output, *page, line);
}

/// page: null for other formats.
MeshReport runMesh(Session& session, const std::string& name, const std::string& output, const CommandLine& line,
                   SharedPage* page, const std::stop_token& stop) {
  requireWritablePlace(output);
  if (!line.picture.empty()) requireWritablePlace(line.picture);
  if (!line.points.empty()) requireWritablePlace(line.points);
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
    seconds[Stage::Read] = readSeconds;
    const Stopwatch writeWatch;
    flipInputFaces(mesh, result.report.reversedFaces);  // The scene of the result has its own copy.
    writeOutput({name, output, line, result}, mesh, page, stop);
    if (!line.points.empty()) writePoints(line.points, result.fields);
    seconds[Stage::Write] = writeWatch.seconds();
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
  if (line.failIfThinner) {
    const ThicknessReport& thickness = *result.report.thickness;
    const ExitCode code = exitCodeOf(thickness, *line.failIfThinner);
    if (code != ExitCode::Done) printError(name, thinFailure(thickness, *line.failIfThinner));
    if (report.code == ExitCode::Done) report.code = code;
  }
  return report;
}

/// Runs `step`, which returns a MeshReport; an exception becomes one and is printed as an error of the mesh.
template <typename Step>
MeshReport reportOf(const std::string& mesh, const CommandLine& line, Step step) {
  try {
    return step();
  } catch (...) {
    Failure failure = currentFailure(line.session.requireGpu, line.valueOptions);
    const std::string prefix = mesh + ": ";  // The messages of readers begin with the file, too.
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
  const Failure failure = currentFailure(line.session.requireGpu);
  printError("", failure.message);
  for (const std::string& mesh : line.meshes)
    if (line.json) writeStandardOutput(jsonFailure(mesh, failure.name, failure.message));
  return failure.code;
}

}  // namespace

ExitCode runMeshes(const CommandLine& line, const std::stop_token& stop) {
  const std::vector<std::string> outputs = planOutputs(line);
  if (line.opensPage) requireBrowser();
  std::optional<Session> session;
  try {
    session.emplace(line.session);
  } catch (...) {
    return failWithoutSession(line);
  }
  if (!line.quiet) printDeviceLines(*session);

  std::vector<const CommandLine*> computations{&line};
  for (const CommandLine& compared : line.compared) computations.push_back(&compared);
  const bool isOnePage = writesOnePage(line);
  std::optional<SharedPage> page;
  ExitCode first = ExitCode::Done;
  for (size_t i = 0; i < line.meshes.size(); ++i) {
    const std::string& mesh = line.meshes[i];
    if (writesPages(line) && (!page || !isOnePage))
      page = SharedPage{.awaitedCount = computations.size() * (isOnePage ? line.meshes.size() : 1)};
    for (const CommandLine* computation : computations) {
      const MeshReport report = reportOf(mesh, *computation, [&] {
        return runMesh(*session, mesh, outputs[i], *computation, page ? &*page : nullptr, stop);
      });
      if (first == ExitCode::Done) first = report.code;
      if (line.json) writeStandardOutput(report.json);
      if (report.code == ExitCode::Cancelled) return first;
      if (!page || --page->awaitedCount > 0 || page->isFinished || page->page.isEmpty()) continue;
      finishPage(outputs[i], *page, line);  // The last result failed, others did not.
    }
  }
  return first;
}

void printDevices(const CommandLine& line) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason);
  writeStandardOutput(line.json ? jsonDevices(devices, reason) : textDevices(devices, reason));
}

}  // namespace asdfvk
