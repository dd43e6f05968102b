#include "cli/batch_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "asdf_vk/asdf_vk.h"
#include "batch/check_report.h"
#include "batch/engine.h"
#include "batch/input_list.h"
#include "batch/output_record.h"
#include "batch/worker.h"
#include "cli/device_output.h"
#include "cli/member_files.h"
#include "cli/mesh_jobs.h"
#include "cli/outputs.h"
#include "cli/report_json.h"
#include "cli/tar_stream.h"
#include "core/abandoned_files.h"
#include "core/atomic_file.h"
#include "core/parallel.h"
#include "page/result_page.h"
#include "pipeline/backend_choice.h"
#include "pipeline/device_sharing.h"
#include "process/interrupt.h"
#include "process/temporary_folder.h"
#include "process/terminal.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kTarExtensions{"tar", "tgz"};  // Also .tar.gz.

/// The failure of a job whose worker process did not return a result.
Failure failureOf(const JobOutcome& outcome, const BatchOptions& batch) {
  const bool isSecond = outcome.attempt > 1;
  switch (outcome.end) {
    case JobEnd::TimedOut:
      return timeLimitFailure(batch.timeoutSeconds);
    case JobEnd::MemoryExceeded:
      return {ExitCode::Limit,
              fmt::format("took {} MiB of memory, more than --memory-limit{}", outcome.peakBytes >> 20,
                          isSecond ? ", also in a second attempt alone" : ""),
              "memoryLimit"};
    case JobEnd::Dropped:
      return cancelledFailure();
    case JobEnd::Terminated:
      return {ExitCode::Internal, "another process ended the worker process by a signal", "crashed"};
    default:
      break;
  }
  if (outcome.workerEnd.signal == SIGKILL)
    return {ExitCode::Internal,
            isSecond
                ? "the worker process was killed (signal 9) in two attempts, the second one alone, probably because "
                  "memory ran out; use a machine with more memory, or a coarser mesh"
                : "the worker process was killed (signal 9), probably because memory ran out; give "
                  "--memory-limit, or fewer --jobs",
            "crashed"};
  return {ExitCode::Internal,
          fmt::format("internal error: the worker process {}; please report it", textOf(outcome.workerEnd)), "crashed"};
}

std::vector<InputFile> inputsOf(const std::vector<std::string>& meshes, const std::string& outputFolder,
                                const BatchOptions& batch) {
  const std::vector<InputFile> inputs = listInputs({.arguments = meshes,
                                                    .recurses = batch.recurses,
                                                    .list = batch.list,
                                                    .isNullSeparated = batch.isNullSeparated,
                                                    .formats = batch.readsTars ? kTarExtensions : meshExtensions(),
                                                    .outputFolder = outputFolder});
  if (inputs.empty())
    throw Error(ErrorCode::UnreadableInput, fmt::format("no {} was found in {}", batch.readsTars ? "tar" : "mesh",
                                                        batch.list.empty() ? "the folders of -r" : "--files-from"));
  return inputs;
}

/// The jobs of this shard. Compares the outputs of all shards, so that no two shards write the same file.
std::vector<Job> jobsOf(const std::vector<InputFile>& inputs, const Outputs& outputs, const BatchOptions& batch) {
  const std::vector<std::string> paths = planOutputs(outputs, batch, inputs);
  std::vector<Job> jobs;
  for (const size_t i : selectShard(inputs, batch.shard.value_or(Shard{}))) {
    std::error_code ignored;
    const fs::file_status status = fs::status(inputs[i].path, ignored);
    const bool isStream = inputs[i].path == "-" || (fs::exists(status) && !fs::is_regular_file(status));
    jobs.push_back(
        {inputs[i].path, paths[i], inputs[i].byteCount, isStream, inputs[i].key, pictureFileOf(inputs[i], outputs)});
  }
  return jobs;
}

/// Removes temporary files that killed processes left in the folders of the outputs.
void removeUnfinishedOutputs(const std::vector<Job>& jobs) {
  std::set<fs::path> folders;
  for (const Job& job : jobs)
    for (const std::string& output : {job.output, job.picture})
      if (!output.empty() && output != "-") folders.insert(fs::path(output).parent_path());
  for (const fs::path& folder : folders) removeAbandonedFiles(folder.empty() ? "." : folder);
}

/// Throws Error{OutputNotWritable} before the first mesh if a tar cannot be written.
void requireWritableTars(const std::vector<Job>& tars, bool makesFolders) {
  for (const Job& tar : tars) {
    if (tar.output.empty() || tar.output == "-") continue;
    if (makesFolders) makeFolderOf(tar.output);
    requireWritablePlace(tar.output);
    requireWritablePlace(outputRecordPath(tar.output).string());
  }
}

/// Calls run(). After an OpenFailure, reports a failure for each unfinished job. Throws the other errors of run().
ExitCode runAndReport(const std::function<void()>& run, const std::function<std::vector<Job>()>& unfinished,
                      Monitor& monitor, bool hasJson) {
  try {
    run();
  } catch (const OpenFailure& failure) {
    printError("", failure.what());
    if (hasJson)
      for (const Job& job : unfinished()) writeStandardOutput(jsonFailure(job.input, failure.name, failure.what()));
    return static_cast<ExitCode>(failure.code);
  } catch (...) {
    monitor.finish();
    throw;
  }
  return ExitCode::Done;
}

/// The records of all jobs, also of those that did not begin.
std::vector<MeshRecord> allRecords(const Monitor& monitor, const std::vector<Job>& unfinished, ExitCode ofUnfinished) {
  std::vector<MeshRecord> records = monitor.records();
  for (const Job& job : unfinished) {
    MeshRecord& record = records.emplace_back();
    record.input = job.input;
    record.key = job.key;
    record.status = MeshStatus::Failed;
    record.code = static_cast<int>(ofUnfinished);
    record.error = "notComputed";
    record.message = "the mesh was not computed, because the run ended before it";
  }
  return records;
}

void writeCheckReport(const Outputs& outputs, const std::vector<MeshRecord>& records) {
  AtomicFile file(outputs.report);
  file.write(checkReport(checkFormatOf(outputs.reportFormat), records));
  file.commit();
}

/// Computes the jobs of a worker process. A signal cancels the current job or ends an idle process.
class WorkerComputer : public JobComputer {
 public:
  explicit WorkerComputer(const Greeting& greeting) : settings_(settingsOf(greeting.settings)), records_(settings_) {
    if (!settings_.memberFolder.empty()) enterMemberFolder(settings_.memberFolder);
    {
      const ThreadLimit limit(greeting.threadCount);  // A CPU device keeps the thread limit under which it was opened.
      computer_.emplace(settings_, records_, interrupt_.token());
    }
    limit_.emplace(computer_->describe().isCpu ? greeting.threadCount : greeting.threadCountOnGpu);
  }

  [[nodiscard]] ComputerDescription describe() const override { return computer_->describe(); }
  [[nodiscard]] JobResult compute(const Job& job, const Job* next) override {
    const Interrupt::Listening listening;
    return computer_->compute(job, next);
  }
  [[nodiscard]] bool isSpent() const override { return computer_->isSpent(); }

 private:
  const Interrupt interrupt_{true};
  const MeshSettings settings_;
  const JobRecords records_;
  std::optional<MeshComputer> computer_;
  std::optional<ThreadLimit> limit_;
};

}  // namespace

void runWorker() {
  serveJobs([](const Greeting& greeting) -> std::unique_ptr<JobComputer> {
    try {
      return std::make_unique<WorkerComputer>(greeting);
    } catch (const OpenFailure&) {
      throw;
    } catch (...) {
      throwOpenFailure(currentFailure());
    }
  });
}

ExitCode computeBatch(const std::vector<std::string>& meshes, const MeshSettings& given, const BatchOptions& batch,
                      const std::stop_token& stop) {
  const Outputs& outputs = given.outputs;
  const std::vector<Job> jobs = jobsOf(inputsOf(meshes, outputs.path, batch), outputs, batch);
  std::optional<TemporaryFolder> memberFolder;
  if (batch.readsTars && outputs.writesResult && !outputs.writesRecordsOnly) memberFolder.emplace();
  const MeshSettings settings =
      batch.readsTars ? memberSettings(given, memberFolder ? memberFolder->path().string() : "") : given;
  if (batch.readsTars) requireWritableTars(jobs, given.makesFolders);
  if (!outputs.reportFormat.empty()) requireWritablePlace(outputs.report);
  if (hasPictureFolder(outputs)) {
    makeFolderOf(outputs.picture);
    requireWritablePlace(outputs.picture + "any.png");
  }
  if (outputs.updatesBaseline) requireWritablePlace(outputs.baseline);
  std::optional<Page> page;
  if (writesOnePage(outputs)) page = emptyPage();
  // In a batch, a signal cancels the current meshes, and the log has a record of each.
  std::optional<Interrupt::Listening> listening;
  if (batch.isBatch()) {
    listening.emplace();
    removeUnfinishedOutputs(jobs);
  }
  if (batch.shard && !batch.shard->variable.empty() && !outputs.quiet)
    writeStandardError(
        fmt::format("asdf-vk: part {} of {}, by {}\n", batch.shard->index, batch.shard->count, batch.shard->variable));
  const std::vector<Job> noJobs;
  Monitor monitor({.log = batch.log,
                   .printsReports = outputs.json,
                   .showsProgress = batch.isBatch(),
                   .keepsRecords = outputs.needsRecords(),
                   .isCheck = isCheck(settings.computation, outputs),
                   .isQuiet = outputs.quiet},
                  batch.readsTars ? noJobs : jobs);
  const JobRecords records(settings);
  const EngineOptions options{.requestedAtOnce = page ? 1 : batch.jobCount,
                              .threadCount = static_cast<uint32_t>(threadLimit()),
                              .isolates = batch.isolates,
                              .timeoutSeconds = batch.timeoutSeconds,
                              .memoryBytes = batch.memoryBytes};
  std::unique_ptr<DeviceSharing> sharing;
  EngineClient client{.open =
                          [&] {
                            const bool showsBar = !batch.isBatch() && !outputs.quiet && !sharing;
                            auto computer = std::make_unique<MeshComputer>(settings, records, stop, showsBar);
                            if (page) computer->collectIn(*page, jobs);
                            return computer;
                          },
                      .shareDevice =
                          [&](uint32_t count) {
                            sharing = DeviceSharing::ofGpu(
                                sessionOptionsFor(settings.session, settings.computation.options), count);
                            return sharing != nullptr;
                          },
                      .fail =
                          [&](const Job& job, const JobOutcome& outcome) {
                            if (memberFolder) removeMemberFolder(memberFolder->path().string(), outcome.worker);
                            return records.fail(job, failureOf(outcome, batch));
                          },
                      .workerArguments = {"asdf-vk", kWorkerArgument},
                      .workerSettings = toJson(settings),
                      .recordOptions = records.options()};
  if (batch.skipsExisting) client.findFinished = [&](const Job& job) { return records.findFinished(job); };
  std::optional<TarStream> tars;
  if (batch.readsTars) tars.emplace(jobs, settings, records, monitor, batch, stop);
  const auto run = [&] {
    if (tars)
      runStream(*tars, options, client, monitor, stop);
    else
      runJobs(jobs, options, client, monitor, stop);
  };
  const auto unfinishedJobs = [&] {
    if (tars) return tars->finish();
    std::vector<Job> unfinished;
    for (const size_t i : monitor.unfinishedJobs()) unfinished.push_back(jobs[i]);
    return unfinished;
  };
  const ExitCode ofDevice = runAndReport(run, unfinishedJobs, monitor, outputs.json);
  const std::vector<Job> unfinished = unfinishedJobs();
  if (batch.isBatch()) removeUnfinishedOutputs(jobs);
  monitor.finish();
  if (!outputs.reportFormat.empty())
    writeCheckReport(outputs,
                     allRecords(monitor, unfinished, ofDevice == ExitCode::Done ? ExitCode::Cancelled : ofDevice));
  if (outputs.updatesBaseline) updateBaseline(outputs.baseline, monitor.records());
  if (stop.stop_requested() && (monitor.hasUnfinished() || !unfinished.empty())) return ExitCode::Cancelled;
  if (ofDevice == ExitCode::Done && page && !page->isEmpty())
    finishPage(*page, jobs.front().output, outputs.opensPage, stop);
  SharedExitCode code;
  for (const int ofMesh : monitor.codes()) {
    const auto each = static_cast<ExitCode>(ofMesh);
    code.add(outputs.updatesBaseline && each == ExitCode::OverLimit ? ExitCode::Done : each);
  }
  // A failed device does not hide a thin mesh.
  return ofDevice == ExitCode::Done || code.code() == ExitCode::OverLimit ? code.code() : ofDevice;
}

}  // namespace asdfvk
