#include "cli/one_mesh.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "asdf_vk/asdf_vk.h"
#include "batch/output_record.h"
#include "cli/device_output.h"
#include "cli/failed_checks.h"
#include "cli/mesh_outcome.h"
#include "cli/outputs.h"
#include "cli/page_output.h"
#include "cli/report_json.h"
#include "cli/report_text.h"
#include "core/atomic_file.h"
#include "core/background_task.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "describe/findings.h"
#include "io/files.h"
#include "io/points_file.h"
#include "mesh/orientation.h"
#include "page/result_page.h"
#include "pipeline/backend_choice.h"
#include "process/browser.h"
#include "process/interrupt.h"
#include "process/terminal.h"
#include "render/png.h"
#include "render/result_picture.h"

namespace asdfvk {

[[gnu::weak]] void beforeMesh(const std::string&) {}

namespace {

namespace fs = std::filesystem;

/// The field that the picture shows; null for the thin places. Throws Error{UnknownField} and Error{OptionConflict}.
const Field* pictureFieldOf(const Outputs& outputs, const Result& result) {
  if (outputs.pictureOf.empty()) return shownField(result);
  const Field* const field = result.field(outputs.pictureOf);
  if (field == nullptr)
    throw Error(ErrorCode::UnknownField, "--picture-of: the result has no field " + outputs.pictureOf);
  if (field->componentCount != 1)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("--picture-of: field {} has {} components; a picture shows a field of one component",
                            outputs.pictureOf, field->componentCount));
  return field;
}

constexpr auto kStopPollTime = std::chrono::milliseconds(20);

/// Waits until another process opens the FIFO for reading. Keeps the FIFO open, so that a later write does not wait.
/// Throws Error{Cancelled}.
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

/// The given options that need shape diameters, for the remedy if no face has a value.
std::string valueOptionsOf(const Options& options) {
  const bool isSegmented = options.segmentation != Segmentation::None;
  if (options.postprocess == Postprocess::None || options.segmentation == Segmentation::Cgal)
    return isSegmented ? "--segment" : "";
  return isSegmented ? "--postprocess and --segment" : "--postprocess";
}

class MeshFiles {
 public:
  MeshFiles(const std::string& input, const std::string& output, const MeshSettings& settings,
            const MeshProgress& progress, const std::stop_token& stop)
      : input_(input), output_(output), settings_(settings), progress_(progress), stop_(stop) {}

  void requireWritable() const {
    if (settings_.makesFolders) makeFolderOf(output_);
    if (!output_.empty()) requireWritablePlace(output_);
    if (settings_.isOfBatch && hasOutputRecord(output_)) requireWritablePlace(outputRecordPath(output_).string());
    if (!settings_.outputs.points.empty()) requireWritablePlace(settings_.outputs.points);
    // The folder of a picture of a failed check is made only with the picture.
    if (!settings_.outputs.picture.empty() && !settings_.drawsFailedOnly)
      requireWritablePlace(settings_.outputs.picture);
  }

  template <typename Work>
  auto withProgress(const Work& work) const {
    const Stopwatch watch;
    std::optional<ProgressBar> bar;
    if (progress_.showsBar && !progress_.receive && isStandardErrorTerminal())
      bar.emplace(writeStandardError, [&watch] { return watch.seconds(); });
    RunControl control;
    control.stop = stop_;
    control.progress = progress_.receive;
    if (bar) control.progress = [&bar](double fraction) { bar->update(fraction); };
    return work(control);
  }

  /// Writes nothing if the output is empty. Precondition: the output is not a page.
  /// fields: those of the mesh.
  void writeResult(AtomicFiles& files, Mesh& mesh, const Options& options, const Result& result,
                   const std::vector<Field>& fields) const {
    if (output_.empty()) return;
    const WriteOptions writing = writeOptionsOf(settings_.outputs, options);
    const auto end = std::lower_bound(result.reversedFaces.begin(), result.reversedFaces.end(), mesh.inputFaceCount());
    flipInputFaces(mesh,
                   {result.reversedFaces.begin(), end});  // The scene of the result has its own copy of the faces.
    const AwaitedReader reader(output_, stop_);
    asdfvk::writeResult(files, output_, mesh, writableFields(writing, options.per, output_, fields), writing);
  }

  void writePage(AtomicFiles& files, const Page& page) const {
    const AwaitedReader reader(output_, stop_);
    asdfvk::writePage(files, output_, page);
  }

  void writePoints(AtomicFiles& files, const std::vector<Field>& fields) const {
    if (settings_.outputs.points.empty()) return;
    const AwaitedReader reader(settings_.outputs.points, stop_);
    asdfvk::writePoints(files, settings_.outputs.points, fields, {stop_, {}, {}});
  }

  /// Whether a picture is asked for, and the mesh is one to draw.
  [[nodiscard]] bool hasPicture(const ComputationSettings& computation, const Report& report) const {
    if (settings_.outputs.picture.empty() || !settings_.drawsFailedOnly) return !settings_.outputs.picture.empty();
    if (!isCheck(settings_.computation, settings_.outputs)) return true;
    const std::vector<Failure> failures = failedChecks(computation, report);
    return std::any_of(failures.begin(), failures.end(),
                       [](const Failure& failure) { return failure.code == ExitCode::OverLimit; });
  }

  /// Writes a picture of the field, or of the thin places if `field` is null. Precondition: result.scene is set.
  void writePicture(AtomicFiles& files, const Result& result, const Field* field) const {
    const Outputs& outputs = settings_.outputs;
    if (settings_.drawsFailedOnly) makeFolderOf(outputs.picture);
    const AwaitedReader reader(outputs.picture, stop_);
    const View view = viewOf(outputs.pictureView, input_, result, field == nullptr && !outputs.choosesView);
    withProgress([&](const RunControl& control) {
      writePng(files, outputs.picture,
               pictureOf(result, field, view, settings_.drawsFailedOnly ? kSmallPicture : PictureStyle{}, control));
    });
  }

 private:
  const std::string& input_;
  const std::string& output_;
  const MeshSettings& settings_;
  const MeshProgress& progress_;
  const std::stop_token stop_;
};

/// Adds warnings, the text report and failed checks. Precondition: the result was written, unless there is no output.
void addReport(const MeshOutcome& outcome, bool isOfBatch, MeshRun& run) {
  const Report& report = outcome.result.report;
  const bool showsReport = !outcome.outputs.quiet && !isOfBatch;
  run.hasResult = true;
  if (showsReport) {
    const std::vector<std::string>& with = outcome.others.with;
    const std::string all = outcome.mesh + (with.empty() ? "" : " with " + joined(with, ", "));
    for (const Warning& warning : report.warnings)
      run.text += warningLine(all, textWarning(warning, OptionSpelling::Flag));
    run.text += textReport(outcome);
  }
  run.report = report;
  if (const size_t count = knownCountOf(report); count > 0)
    run.text +=
        oneLine(fmt::format("asdf-vk: {}: known by the baseline: {}", outcome.mesh, counted(count, "place"))) + "\n";
  for (Failure& failure : failedChecks(outcome.computation, report)) {
    // The first line of a shown report already has the verdict on the thickness.
    const bool isVerdict = failure.name != "checkFailed";
    if (!isVerdict)
      run.text += errorLine(outcome.mesh, failure.message);
    else if (!showsReport)
      run.text += oneLine(fmt::format("asdf-vk: {}: {}", outcome.mesh, failure.message)) + "\n";
    if (!run.failure) run.failure = std::move(failure);
  }
}

}  // namespace

void MeshRun::add(Failure failed, const std::string& input, bool hasJson) {
  const std::string prefix = oneLine(input + ": ");  // The messages of readers also begin with the name of the file.
  if (failed.message.starts_with(prefix)) failed.message.erase(0, prefix.size());
  text += errorLine(input, failed.message);
  if (hasJson) json += jsonFailure(input, failed.name, failed.message);
  if (!failure || failed.code == ExitCode::Cancelled) failure = std::move(failed);
}

MeshRun computeMesh(Session& session, const std::string& input, const std::string& output, LoadedMesh loaded,
                    const MeshSettings& settings, const Deadline& deadline, const MeshProgress& progress,
                    const SharedPage* sharedPage) {
  MeshRun run;
  const MeshFiles files(input, output, settings, progress, deadline.token());
  std::optional<Page> ownPage;
  if (sharedPage == nullptr && writesPages(settings.outputs)) ownPage = emptyPage();
  Page* const page = sharedPage != nullptr ? &sharedPage->page : ownPage ? &*ownPage : nullptr;
  const PageMesh shown{sharedPage != nullptr ? sharedPage->name : nameInPage(input), !settings.isOfBatch};
  const auto compute = [&] {
    const ComputationSettings computation = settings.policy.limits.applied(input, settings.computation);
    const CheckedOptions options = computation.checked();
    ComputedMesh computed = files.withProgress([&](const RunControl& control) {
      return settings.others.isEmpty()
                 ? ComputedMesh{{}, session.compute(loaded.mesh, options, control)}
                 : computeAmong(session, loaded.mesh, input, settings.others, settings.reading, options, control);
    });
    Result& result = computed.result;
    if (deadline.token().stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
    const auto find = [&] {
      result.report.findings = findingsOf(result.report, {computation.failsIfVoids, computation.failsIfContact});
      settings.policy.baseline.mark(input, result.report.findings);
    };
    find();
    StageSeconds& seconds = result.report.stageSeconds;
    seconds[Stage::Read] += loaded.seconds;
    Outputs outputs = settings.outputs;
    if (!files.hasPicture(computation, result.report)) outputs.picture.clear();
    const bool hasPicture = !outputs.picture.empty();
    const Field* const pictureField = hasPicture ? pictureFieldOf(outputs, result) : nullptr;
    const MeshOutcome outcome{input,           output,  computation, settings.session,
                              settings.others, outputs, result,      computed.faceCounts};
    const Stopwatch watch;
    removeOutputRecord(output);
    AtomicFiles written;
    // Pages and pictures also show the other meshes; files and reports have the fields of the mesh only.
    const bool isAmongOthers = !settings.others.with.empty();
    std::vector<Field> ofMesh;
    if (isAmongOthers) ofMesh = fieldsOfMesh(loaded.mesh, result.fields);
    const std::vector<Field>& fields = isAmongOthers ? ofMesh : result.fields;
    if (page == nullptr) {
      files.writeResult(written, loaded.mesh, *options, result, fields);
    } else {
      files.withProgress([&](const RunControl& control) { addToPage(*page, outcome, shown, control); });
      if (ownPage) files.writePage(written, *ownPage);
    }
    files.writePoints(written, fields);
    seconds[Stage::Write] = watch.seconds();
    if (hasPicture) files.writePicture(written, result, pictureField);
    written.commit();
    run.picture = outputs.picture;
    if (ownPage && settings.outputs.opensPage) openInBrowser(output);
    if (isAmongOthers) result.fields = std::move(ofMesh);
    if (settings.outputs.json) run.json += jsonReport(outcome);
    if (isAmongOthers) {
      numberFacesByFile(result.report, loaded.mesh.inputFaceCount(), computed.faceCounts);
      find();
    }
    addReport(outcome, settings.isOfBatch, run);
  };

  const Interrupt::Listening listening;
  try {
    beforeMesh(input);
    if (loaded.failure) std::rethrow_exception(loaded.failure);
    files.requireWritable();
    compute();
  } catch (...) {
    Failure failure = currentFailure(settings.session.requireGpu, valueOptionsOf(settings.computation.options));
    if (failure.code == ExitCode::Cancelled && deadline.hasExpired())
      failure = timeLimitFailure(settings.timeoutSeconds);
    std::error_code ignored;
    if (loaded.failure && fs::is_directory(input, ignored))
      failure.message += "; -r computes all meshes below a folder";
    run.add(std::move(failure), input, settings.outputs.json);
  }
  return run;
}

void finishPage(const Page& page, const std::string& output, bool opensBrowser, const std::stop_token& stop) {
  const AwaitedReader reader(output, stop);
  writePage(output, page);
  if (opensBrowser) openInBrowser(output);
}

ExitCode computeOneMesh(const std::string& input, const MeshSettings& settings, const std::stop_token& stop) {
  const InputFile file{.path = input};
  const std::string output = planOutputs(settings.outputs, {}, {&file, 1}).front();
  LoadedMesh loaded;
  // The device is opened while the mesh is read and prepared. A failure of the device is reported instead of one of the
  // mesh.
  std::optional<BackgroundTask> reading;
  if (!mayWait(input)) reading.emplace([&] { loaded = loadMesh(input, settings.reading, false, {}); });
  std::optional<Session> session;
  const auto reportOpenFailure = [&] {
    const Failure failure = currentFailure(settings.session.requireGpu);
    printError("", failure.message);
    if (settings.outputs.json) writeStandardOutput(jsonFailure(input, failure.name, failure.message));
    return failure.code;
  };
  const SessionOptions sessionOptions = sessionOptionsFor(settings.session, settings.computation.options);
  try {
    session.emplace(sessionOptions, SessionOpening::InThread);
  } catch (...) {
    return reportOpenFailure();
  }
  const bool printsDevice = !settings.outputs.quiet, wasOpen = session->isOpen();
  const auto printDevice = [&] {
    writeStandardError(deviceLinesOf(*session, sessionOptions, settings.outputs.verbose));
  };
  if (printsDevice && wasOpen) printDevice();
  const Deadline deadline(settings.timeoutSeconds, stop);
  if (reading)
    reading->wait();
  else
    loaded = loadMesh(input, settings.reading, false, deadline.token());
  const MeshRun run = computeMesh(*session, input, output, std::move(loaded), settings, deadline,
                                  {.showsBar = !settings.outputs.quiet});
  if (!deadline.token().stop_requested()) {
    try {
      session->finishOpening();
    } catch (...) {
      return reportOpenFailure();
    }
    if (printsDevice && !wasOpen && session->isOpen()) printDevice();
    if (printsDevice && run.report) writeStandardError(deviceChoiceLine(*run.report, settings.outputs.verbose));
  }
  writeStandardError(run.text);
  writeStandardOutput(run.json);
  return run.failure ? run.failure->code : ExitCode::Done;
}

}  // namespace asdfvk
