#include "cli/run.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/asdf_vk.h"
#include "cli/interrupt.h"
#include "cli/output_plan.h"
#include "cli/report.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "mesh/orientation.h"
#include "render/picture.h"
#include "render/png.h"
#include "trace/scene_data.h"

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

/// From entries per input face to entries per triangle.
template <typename T>
std::vector<T> onTriangles(const TriangleMesh& mesh, const std::vector<T>& ofInputFaces) {
  if (mesh.polygons.isEmpty()) return ofInputFaces;
  std::vector<T> result;
  result.reserve(mesh.faces.size());
  for (const uint32_t inputFace : mesh.polygons.inputFaceOf) result.push_back(ofInputFaces[inputFace]);
  return result;
}

/// Renders the field of --picture-of and writes it atomically. Precondition: result.scene is set. Throws
/// Error{OutputNotWritable}, Error{UnknownField} and Error{Cancelled}.
void writePicture(const CommandLine& line, const Result& result, const RunControl& control) {
  const Field* field = result.field(line.pictureOf);
  if (field == nullptr) throw Error(ErrorCode::UnknownField, "--picture-of: the result has no field " + line.pictureOf);
  if (field->componentCount != 1)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("--picture-of: field {} has {} components; a picture shows a field of one component",
                            line.pictureOf, field->componentCount));
  const TriangleMesh& mesh = result.scene->scene.mesh;
  Picture picture{.scene = result.scene->scene, .title = field->label, .view = line.pictureView};
  std::vector<double> values;
  std::vector<uint8_t> flags;
  std::vector<uint32_t> labels;
  if (const std::vector<double>* reals = field->reals()) {
    values = onTriangles(mesh, *reals);
    picture.values = values;
  } else if (const auto* marks = std::get_if<std::vector<uint8_t>>(&field->values)) {
    flags = onTriangles(mesh, *marks);
    picture.highlighted = flags;
  } else if (const auto* indices = std::get_if<std::vector<uint32_t>>(&field->values)) {
    labels = onTriangles(mesh, *indices);
    picture.labels = labels;
  }
  writePng(line.picture, render(picture, control));
}

MeshReport runMesh(Session& session, const std::string& name, const std::string& output, const CommandLine& line,
                   const std::stop_token& stop) {
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
    const Stopwatch writeWatch;
    flipInputFaces(mesh, result.report.reversedFaces);  // The scene of the result has its own copy.
    writeResult(output, mesh, writableFields(line, output, result.fields), writeOptionsOf(line));
    if (!line.points.empty()) writePoints(line.points, result.fields);
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
    const MeshReport report = reportOf(mesh, line, [&] { return runMesh(*session, mesh, outputs[i], line, stop); });
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
