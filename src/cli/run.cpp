#include "cli/run.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "asdf_vk/asdf_vk.h"
#include "batch/input_list.h"
#include "cli/batch_monitor.h"
#include "cli/browser.h"
#include "cli/interrupt.h"
#include "cli/isolated_jobs.h"
#include "cli/job_plan.h"
#include "cli/job_threads.h"
#include "cli/mesh_run.h"
#include "cli/output_plan.h"
#include "cli/report.h"
#include "cli/terminal.h"
#include "core/atomic_file.h"

namespace asdfvk {
namespace {

std::vector<InputFile> inputsOf(const CommandLine& line) {
  const BatchOptions& batch = line.batch;
  const std::vector<InputFile> inputs = listInputs({.arguments = line.meshes,
                                                    .recurses = batch.recurses,
                                                    .list = batch.list,
                                                    .isNullSeparated = batch.isNullSeparated,
                                                    .formats = meshFormats(),
                                                    .outputFolder = line.output});
  if (inputs.empty())
    throw Error(ErrorCode::UnreadableInput,
                batch.list.empty() ? "no mesh was found in the folders of -r" : "no mesh was found in --files-from");
  return inputs;
}

/// The outputs of all inputs are checked against each other, also those of other shards.
std::vector<MeshTask> tasksOf(const CommandLine& line) {
  std::vector<InputFile> inputs = inputsOf(line);
  std::vector<std::string> outputs = planOutputs(line, inputs);
  if (line.batch.shard) {
    inputs = selectShard(inputs, *line.batch.shard);
    outputs = planOutputs(line, inputs);
  }
  std::vector<MeshTask> tasks;
  tasks.reserve(inputs.size());
  for (size_t i = 0; i < inputs.size(); ++i) tasks.push_back({inputs[i].path, outputs[i], inputs[i].byteCount});
  return tasks;
}

/// Earlier runs that were killed may have left such files, and workers that were killed at the end of this one.
void removeUnfinishedOutputs(const std::vector<MeshTask>& tasks) {
  std::set<std::filesystem::path> folders;
  for (const MeshTask& task : tasks) folders.insert(std::filesystem::path(task.output).parent_path());
  for (const std::filesystem::path& folder : folders) removeAbandonedFiles(folder.empty() ? "." : folder);
}

std::vector<JobPhase> phasesOf(const CommandLine& line, const std::vector<MeshTask>& tasks,
                               std::vector<size_t> computed) {
  const auto threadCount =
      static_cast<uint32_t>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return planJobs(tasks, std::move(computed), writesOnePage(line) ? 1 : line.batch.jobCount, threadCount);
}

/// The tasks that no earlier run has finished. Adds the others to the monitor.
std::vector<size_t> unfinishedTasks(const CommandLine& line, const MeshRunner& runner, BatchMonitor& monitor,
                                    const std::vector<MeshTask>& tasks, const std::stop_token& stop) {
  std::vector<size_t> unfinished(tasks.size());
  std::iota(unfinished.begin(), unfinished.end(), size_t{0});
  if (!line.batch.skipsExisting) return unfinished;
  std::vector<char> isFinished(tasks.size(), 0);
  tbb::parallel_for(size_t{0}, tasks.size(), [&](size_t task) {
    if (stop.stop_requested()) return;
    std::optional<MeshRun> skipped = runner.skip(tasks[task]);
    if (!skipped) return;
    monitor.add(task, std::move(*skipped));
    isFinished[task] = 1;
  });
  std::erase_if(unfinished, [&](size_t task) { return isFinished[task] != 0; });
  return unfinished;
}

/// To be called while the exception is handled.
ExitCode failWithoutSession(const CommandLine& line, const std::vector<MeshTask>& tasks,
                            const std::vector<JobPhase>& phases) {
  const Failure failure = currentFailure(line.session.requireGpu);
  printError("", failure.message);
  if (line.json)
    for (const JobPhase& phase : phases)
      for (const size_t task : phase.tasks)
        writeStandardOutput(jsonFailure(tasks[task].input, failure.name, failure.message));
  return failure.code;
}

/// The jobs of one process.
ExitCode runHere(const CommandLine& line, MeshRunner& runner, BatchMonitor& monitor, const std::vector<MeshTask>& tasks,
                 const std::vector<JobPhase>& phases, const std::stop_token& stop) {
  std::unique_ptr<Session> session;
  try {
    session = openSession(line, phases.front().threadCount);
  } catch (...) {
    return failWithoutSession(line, tasks, phases);
  }
  monitor.announce(session->backend(), deviceLinesOf(*session));
  runOnThreads(line, runner, monitor, tasks, phases, std::move(session), stop);
  return ExitCode::Done;
}

}  // namespace

ExitCode runMeshes(const CommandLine& line, const std::vector<std::string>& arguments, const std::stop_token& stop) {
  const std::vector<MeshTask> tasks = tasksOf(line);
  if (line.opensPage) requireBrowser();
  std::optional<Interrupt::Listening> listening;  // In a batch a signal drops the meshes at hand, and the log says so.
  if (line.batch.isBatch()) {
    listening.emplace();
    removeUnfinishedOutputs(tasks);
  }
  BatchMonitor monitor(line, tasks);
  MeshRunner runner(line, tasks.size());
  const std::vector<JobPhase> phases = phasesOf(line, tasks, unfinishedTasks(line, runner, monitor, tasks, stop));
  monitor.beginComputation();
  ExitCode code = ExitCode::Done;
  if (!phases.empty() && !stop.stop_requested()) {  // Else no device is opened.
    if (!line.batch.isBatch() && phases.back().jobCount == 1) runner.showProgressOfMeshes();
    try {
      code = line.batch.isolates ? runIsolated(line, arguments, runner, monitor, tasks, phases, stop)
                                 : runHere(line, runner, monitor, tasks, phases, stop);
    } catch (...) {
      static_cast<void>(monitor.finish());
      throw;
    }
  }
  if (line.batch.isBatch()) removeUnfinishedOutputs(tasks);
  const ExitCode ofMeshes = monitor.finish();
  if (stop.stop_requested() && monitor.hasUnfinished()) return ExitCode::Cancelled;
  return code == ExitCode::Done ? ofMeshes : code;
}

void printDevices(const CommandLine& line) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason);
  writeStandardOutput(line.json ? jsonDevices(devices, reason) : textDevices(devices, reason));
}

}  // namespace asdfvk
