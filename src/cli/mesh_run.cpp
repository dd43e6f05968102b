#include "cli/mesh_run.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <future>
#include <thread>
#include <utility>

#include "asdf_vk/asdf_vk.h"
#include "asdf_vk/version.h"
#include "batch/content_hash.h"
#include "batch/mesh_timer.h"
#include "batch/output_record.h"
#include "batch/process_memory.h"
#include "cli/browser.h"
#include "cli/interrupt.h"
#include "cli/options_hash.h"
#include "cli/output_plan.h"
#include "cli/report.h"
#include "cli/result_picture.h"
#include "cli/terminal.h"
#include "core/json.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "io/inspected_mesh.h"
#include "mesh/orientation.h"
#include "render/png.h"

namespace asdfvk {

void (*beforeMesh)(const std::string& input) = nullptr;

namespace {

namespace fs = std::filesystem;

/// Runs `work`, which takes a RunControl, with a bar on a terminal.
template <typename Work>
auto runWithProgress(bool showsBar, const std::stop_token& stop, const Work& work) {
  const Stopwatch watch;
  std::optional<ProgressBar> bar;
  if (showsBar && isStandardErrorTerminal()) bar.emplace(writeStandardError, [&watch] { return watch.seconds(); });
  RunControl control;
  control.stop = stop;
  if (bar) control.progress = [&bar](double fraction) { bar->update(fraction); };
  return work(control);
}

/// The field of --picture-of, null for the thin places. Throws Error{UnknownField} and Error{OptionConflict}.
const Field* pictureFieldOf(const Outputs& outputs, const Result& result) {
  if (outputs.pictureOf.empty()) return nullptr;
  const Field* const field = result.field(outputs.pictureOf);
  if (field == nullptr)
    throw Error(ErrorCode::UnknownField, "--picture-of: the result has no field " + outputs.pictureOf);
  if (field->componentCount != 1)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("--picture-of: field {} has {} components; a picture shows a field of one component",
                            outputs.pictureOf, field->componentCount));
  return field;
}

/// Renders the field, or the thin places without one, and writes it atomically. Precondition: result.scene is set.
/// Throws Error{OutputNotWritable} and Error{Cancelled}.
void writePicture(const Outputs& outputs, const std::string& input, const Result& result, const Field* field,
                  const RunControl& control) {
  const View view = viewOf(outputs, input, result, field == nullptr);
  writePng(outputs.picture,
           field == nullptr ? thinPictureOf(result, view, {}, control) : pictureOf(result, *field, view, {}, control));
}

constexpr auto kStopPollTime = std::chrono::milliseconds(20);

/// Waits until an output that is a FIFO has a reader, and keeps it open: the next opening does not wait. Throws
/// Error{Cancelled}.
class AwaitedReader {
 public:
  AwaitedReader(const std::string& output, const std::stop_token& stop) {
    std::error_code ignored;
    if (!fs::is_fifo(output, ignored)) return;
    while ((descriptor_ = ::open(output.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)) < 0 && errno == ENXIO) {
      if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
      std::this_thread::sleep_for(kStopPollTime);
    }
  }
  ~AwaitedReader() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  AwaitedReader(const AwaitedReader&) = delete;
  AwaitedReader& operator=(const AwaitedReader&) = delete;

 private:
  int descriptor_ = -1;
};

SharedJson shortEstimateOf(const std::optional<ErrorEstimate>& estimate) {
  if (!estimate) return nullptr;
  return std::make_shared<const Json>(Json{{"average", number(estimate->average)},
                                           {"standardError", number(estimate->standardError)},
                                           {"relativeMedian", number(estimate->relativeMedian)},
                                           {"relativePercentile90", number(estimate->relativePercentile90)}});
}

void fillRecord(MeshRecord& record, const Report& report) {
  record.faceCount = report.faceCount;
  record.device = report.device;
  record.backend = report.backend;
  for (size_t i = 0; i < kStageCount; ++i)
    if (const double seconds = report.stageSeconds.seconds[i]; seconds > 0)
      record.seconds.emplace_back(nameOf(static_cast<Stage>(i)), seconds);
  record.estimatedError = shortEstimateOf(report.estimatedError);
  if (report.segmentation) record.segmentCount = report.segmentation->segmentCount;
  for (const Warning& warning : report.warnings) record.warnings.emplace_back(nameOf(warning.code));
}

/// The requested checks that failed or could not be made.
std::vector<Failure> failedChecks(const Computation& computation, const Report& report) {
  std::vector<Failure> failures;
  if (report.check && exitCodeOf(*report.check) != ExitCode::Done)
    failures.push_back({ExitCode::CheckFailed, checkFailure(*report.check), "checkFailed"});
  if (!computation.failIfThinner) return failures;
  const ExitCode code = exitCodeOf(*report.thickness);
  if (code != ExitCode::Done)
    failures.push_back(
        {code, thicknessVerdict(*report.thickness), code == ExitCode::TooThin ? "tooThin" : "notJudged"});
  return failures;
}

/// The file name, or the path where another mesh of the page has the same file name.
std::string shownName(const std::string& mesh, const CommandLine& line) {
  if (mesh == "-") return "standard input";
  const auto fileNameOf = [](const std::string& path) { return fs::path(path).filename().string(); };
  const std::string name = fileNameOf(mesh);
  if (line.batch.isBatch()) return name;  // The page has no other mesh.
  const auto sameCount = std::count_if(line.meshes.begin(), line.meshes.end(),
                                       [&](const std::string& other) { return fileNameOf(other) == name; });
  return sameCount > 1 ? mesh : name;
}

void makeFolderOf(const std::string& output) {
  const fs::path folder = fs::path(output).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("{} cannot be written: {}: {}", output, folder.string(), error.message()));
}

}  // namespace

namespace {

LoadedMesh loadNow(const std::string& path, bool computesHash) {
  LoadedMesh loaded;
  const Stopwatch watch;
  try {
    loaded.mesh = readMesh(path, [&](std::span<const char> bytes) {
      if (computesHash) loaded.hash = contentHash(bytes);
    });
  } catch (...) {
    loaded.failure = std::current_exception();
  }
  loaded.seconds = watch.seconds();
  return loaded;
}

/// Whether its opening or reading may wait for another process.
bool mayWait(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return path == "-" || (fs::exists(status) && !fs::is_regular_file(status));
}

}  // namespace

LoadedMesh loadMesh(const std::string& path, bool computesHash, const std::stop_token& stop) {
  if (!mayWait(path)) return loadNow(path, computesHash);
  std::packaged_task<LoadedMesh()> task([path, computesHash] { return loadNow(path, computesHash); });
  std::future<LoadedMesh> loaded = task.get_future();
  std::thread(std::move(task)).detach();  // The call of the system cannot be ended before the process.
  while (loaded.wait_for(kStopPollTime) != std::future_status::ready)
    if (stop.stop_requested()) return {.failure = std::make_exception_ptr(Error(ErrorCode::Cancelled, "cancelled"))};
  return loaded.get();
}

MeshRunner::MeshRunner(const CommandLine& line, size_t meshCount)
    : line_(line),
      optionsHash_(optionsHash(line.computation, line.compared, line.session, line.outputs)),
      options_(std::make_shared<const Json>(optionValues(line.computation, line.session))) {
  if (writesOnePage(line.outputs)) onePage_ = SharedPage{.awaitedCount = meshCount * (1 + (line.compared ? 1 : 0))};
}

MeshRecord MeshRunner::recordOf(const MeshTask& task) const {
  MeshRecord record;
  record.input = task.input;
  record.time = utcTime();
  record.optionsHash = optionsHash_;
  record.options = options_;
  record.version = ASDFVK_VERSION;
  record.commit = ASDFVK_COMMIT;
  return record;
}

std::optional<MeshRun> MeshRunner::skip(const MeshTask& task) const {
  std::error_code ignored;
  if (!fs::exists(outputRecordPath(task.output), ignored)) return std::nullopt;
  MeshRecord expected = recordOf(task);
  expected.inputHash = contentHashOf(task.input).value_or("");
  std::optional<MeshRecord> found = findFinishedOutput(expected, task.output);
  if (!found) return std::nullopt;
  MeshRun run;
  run.json = jsonSkipped(task.input, *found);
  run.record = std::move(*found);
  return run;
}

MeshRun MeshRunner::run(Session& session, const MeshTask& task, std::optional<LoadedMesh> loaded, bool measuresMemory,
                        const std::stop_token& stop) {
  MeshRun run;
  run.record = recordOf(task);
  const std::optional<MeshRecord> old = line_.batch.isBatch() ? readOutputRecord(task.output) : std::nullopt;
  const Stopwatch watch;
  if (measuresMemory) resetPeakMemory();
  const MeshTimer timer(line_.batch.timeoutSeconds, stop);
  std::optional<SharedPage> ownPage;
  SharedPage* page = onePage_ ? &*onePage_ : nullptr;
  if (writesPages(line_.outputs) && page == nullptr)
    page = &ownPage.emplace(SharedPage{.awaitedCount = 1 + (line_.compared ? 1 : 0)});

  std::vector<const Computation*> computations{&line_.computation};
  if (line_.compared) computations.push_back(&*line_.compared);
  for (const Computation* computation : computations) {
    if (run.code == ExitCode::Cancelled) break;
    try {
      if (beforeMesh != nullptr) beforeMesh(task.input);
      if (!loaded) loaded = loadMesh(task.input, line_.batch.isBatch(), timer.token());
      LoadedMesh mesh = std::move(*loaded);
      loaded.reset();
      if (!mesh.hash.empty()) run.record.inputHash = mesh.hash;
      if (mesh.failure) std::rethrow_exception(mesh.failure);
      compute(session, task, *computation, mesh, page, timer.token(), run);
    } catch (...) {
      Failure failure = currentFailure(line_.session.requireGpu, computation->valueOptions);
      if (failure.code == ExitCode::Cancelled && timer.hasExpired())
        failure = timeLimitFailure(line_.batch.timeoutSeconds);
      addFailure(task, failure, run);
    }
    if (page == nullptr || --page->awaitedCount > 0 || page->isFinished || page->page.isEmpty()) continue;
    if (run.code == ExitCode::Cancelled) continue;
    try {
      finishPage(task.output, *page);  // The last result failed, others did not.
    } catch (...) {
      addFailure(task, currentFailure(), run);
    }
  }
  run.record.totalSeconds = watch.seconds();
  run.record.peakMemoryBytes = peakMemoryBytes();
  if (run.code == ExitCode::Done && line_.batch.isBatch()) writeRecord(task, run);
  if (old && !hasResult(run.code) && run.code != ExitCode::Cancelled)
    removeOutdatedOutput(*old, run.record, task.output);
  return run;
}

void MeshRunner::writeRecord(const MeshTask& task, MeshRun& run) const {
  try {
    writeOutputRecord(run.record, task.output);
  } catch (...) {
    addFailure(task, currentFailure(), run);
    removeOutput(run.record, task.output);
    run.record.output.reset();
    run.record.outputHash.clear();
  }
}

void MeshRunner::compute(Session& session, const MeshTask& task, const Computation& computation, LoadedMesh& loaded,
                         SharedPage* page, const std::stop_token& stop, MeshRun& run) const {
  const Outputs& outputs = line_.outputs;
  const bool isFirst = &computation == &line_.computation;  // Picture and points show this one.
  if (line_.batch.hasTree() || outputs.path.ends_with('/')) makeFolderOf(task.output);
  requireWritablePlace(task.output);
  if (line_.batch.isBatch() && hasOutputRecord(task.output))
    requireWritablePlace(outputRecordPath(task.output).string());
  if (!outputs.picture.empty()) requireWritablePlace(outputs.picture);
  if (!outputs.points.empty()) requireWritablePlace(outputs.points);
  Mesh& mesh = loaded.mesh;
  Result result;
  {
    const Interrupt::Listening listening;
    result = runWithProgress(showsBar_, stop, [&](const RunControl& control) {
      return session.compute(mesh, computation.options, control);
    });
    if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
    StageSeconds& seconds = result.report.stageSeconds;
    seconds[Stage::Read] = loaded.seconds;
    const bool hasPicture = isFirst && !outputs.picture.empty();
    const Field* const pictureField = hasPicture ? pictureFieldOf(outputs, result) : nullptr;
    const Stopwatch writeWatch;
    flipInputFaces(mesh, result.report.reversedFaces);  // The scene of the result has its own copy.
    removeOutputRecord(task.output);
    writeOutput({task.input, task.output, computation, line_.session, outputs, result}, mesh, page, stop);
    if (isFirst && !outputs.points.empty()) {
      const AwaitedReader reader(outputs.points, stop);
      writePoints(outputs.points, result.fields);
    }
    seconds[Stage::Write] = writeWatch.seconds();
    if (hasPicture) {
      const AwaitedReader reader(outputs.picture, stop);
      runWithProgress(showsBar_, stop, [&](const RunControl& control) {
        writePicture(outputs, task.input, result, pictureField, control);
      });
    }
  }
  describe(task, {task.input, task.output, computation, line_.session, outputs, result}, run);
}

/// Writes the result, or adds it to the page, which is written with its last result.
void MeshRunner::writeOutput(const MeshOutcome& outcome, const Mesh& mesh, SharedPage* page,
                             const std::stop_token& stop) const {
  if (page == nullptr) {
    const AwaitedReader reader(outcome.output, stop);
    const WriteOptions options = writeOptionsOf(outcome.outputs, outcome.computation.options);
    writeResult(outcome.output, mesh,
                writableFields(options, outcome.computation.options.per, outcome.output, outcome.result.fields),
                options);
    return;
  }
  const PageMesh shown{shownName(outcome.mesh, line_), !line_.batch.isBatch()};
  runWithProgress(showsBar_, stop, [&](const RunControl& control) { addToPage(page->page, outcome, shown, control); });
  if (page->awaitedCount > 1) return;
  const AwaitedReader reader(outcome.output, stop);
  finishPage(outcome.output, *page);
}

/// Also starts the browser with --open.
void MeshRunner::finishPage(const std::string& output, SharedPage& page) const {
  page.isFinished = true;
  writePage(output, page.page);
  if (line_.outputs.opensPage) openInBrowser(output);
}

void MeshRunner::describe(const MeshTask& task, const MeshOutcome& outcome, MeshRun& run) const {
  const Report& report = outcome.result.report;
  if (!outcome.outputs.quiet && !line_.batch.isBatch()) {
    for (const Warning& warning : report.warnings) run.text += warningLine(task.input, textWarning(warning));
    run.text += textReport(outcome);
  }
  if (outcome.outputs.json) run.json += jsonReport(outcome);
  if (outcome.computation.against.empty()) fillRecord(run.record, report);
  run.record.output = task.output;
  for (const Failure& failure : failedChecks(outcome.computation, report)) {
    run.text += errorLine(task.input, failure.message);
    if (run.code != ExitCode::Done) continue;
    run.code = failure.code;
    run.record.status = MeshStatus::Failed;
    run.record.code = static_cast<int>(failure.code);
    run.record.error = failure.name;
    run.record.message = oneLine(failure.message);
  }
}

void MeshRunner::addFailure(const MeshTask& task, const Failure& failure, MeshRun& run) const {
  std::string message = failure.message;
  const std::string prefix = task.input + ": ";  // The messages of readers begin with the file, too.
  if (message.starts_with(oneLine(prefix))) message.erase(0, prefix.size());
  run.text += errorLine(task.input, message);
  if (line_.outputs.json) run.json += jsonFailure(task.input, failure.name, message);
  if (failure.code == ExitCode::Cancelled) run.record.status = MeshStatus::Dropped;
  if (run.code != ExitCode::Done && failure.code != ExitCode::Cancelled) return;
  if (failure.code != ExitCode::Cancelled) run.record.status = MeshStatus::Failed;
  run.code = failure.code;
  run.record.code = static_cast<int>(failure.code);
  run.record.error = failure.name;
  run.record.message = message;
}

MeshRun MeshRunner::failedRun(const MeshTask& task, const Failure& failure) const {
  MeshRun run;
  run.record = recordOf(task);
  addFailure(task, failure, run);
  const std::optional<MeshRecord> old = readOutputRecord(task.output);
  if (!old || run.code == ExitCode::Cancelled) return run;
  run.record.inputHash = contentHashOf(task.input).value_or("");
  removeOutdatedOutput(*old, run.record, task.output);
  return run;
}

}  // namespace asdfvk
