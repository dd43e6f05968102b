#include "cli/run.h"

#include <algorithm>
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
#include "core/parallel.h"

namespace asdfvk {
namespace {

std::vector<InputFile> inputsOf(const CommandLine& line) {
  const BatchOptions& batch = line.batch;
  const std::vector<InputFile> inputs = listInputs({.arguments = line.meshes,
                                                    .recurses = batch.recurses,
                                                    .list = batch.list,
                                                    .isNullSeparated = batch.isNullSeparated,
                                                    .formats = meshFormats(),
                                                    .outputFolder = line.outputs.path});
  if (inputs.empty())
    throw Error(ErrorCode::UnreadableInput,
                batch.list.empty() ? "no mesh was found in the folders of -r" : "no mesh was found in --files-from");
  return inputs;
}

/// The outputs of all inputs are checked against each other, also those of other shards.
std::vector<MeshTask> tasksOf(const CommandLine& line) {
  const std::vector<InputFile> inputs = inputsOf(line);
  const std::vector<std::string> outputs = planOutputs(line, inputs);
  std::vector<MeshTask> tasks;
  for (const size_t i : selectShard(inputs, line.batch.shard.value_or(Shard{})))
    tasks.push_back({inputs[i].path, outputs[i], inputs[i].byteCount});
  return tasks;
}

/// Removes the temporary files of earlier runs that were killed, and of workers that were killed at the end of this
/// run.
void removeUnfinishedOutputs(const std::vector<MeshTask>& tasks) {
  std::set<std::filesystem::path> folders;
  for (const MeshTask& task : tasks) folders.insert(std::filesystem::path(task.output).parent_path());
  for (const std::filesystem::path& folder : folders) removeAbandonedFiles(folder.empty() ? "." : folder);
}

std::vector<JobPhase> phasesOf(const CommandLine& line, const std::vector<MeshTask>& tasks,
                               std::vector<size_t> computed) {
  const auto threadCount = static_cast<uint32_t>(threadLimit());
  return planJobs(tasks, std::move(computed), writesOnePage(line.outputs) ? 1 : line.batch.jobCount, threadCount);
}

/// The tasks that no earlier run has finished. Adds the others to the monitor.
std::vector<size_t> unfinishedTasks(const JobContext& context) {
  std::vector<size_t> unfinished(context.tasks.size());
  std::iota(unfinished.begin(), unfinished.end(), size_t{0});
  if (!context.line.batch.skipsExisting) return unfinished;
  std::vector<char> isFinished(context.tasks.size(), 0);
  forEachTask(context.tasks.size(), [&](size_t task) {
    if (context.stop.stop_requested()) return;
    std::optional<MeshRun> skipped = context.runner.skip(context.tasks[task]);
    if (!skipped) return;
    context.monitor.add(task, std::move(*skipped));
    isFinished[task] = 1;
  });
  std::erase_if(unfinished, [&](size_t task) { return isFinished[task] != 0; });
  return unfinished;
}

/// To be called while the exception is handled.
ExitCode failWithoutSession(const JobContext& context, const std::vector<JobPhase>& phases) {
  const Failure failure = currentFailure(context.line.session.requireGpu);
  printError("", failure.message);
  if (context.line.outputs.json)
    for (const JobPhase& phase : phases)
      for (const size_t task : phase.tasks)
        writeStandardOutput(jsonFailure(context.tasks[task].input, failure.name, failure.message));
  return failure.code;
}

/// The jobs of one process.
ExitCode runHere(const JobContext& context, const std::vector<JobPhase>& phases) {
  std::unique_ptr<Session> session;
  try {
    session = openSession(context.line, phases.front().threadCount);
  } catch (...) {
    return failWithoutSession(context, phases);
  }
  context.monitor.announce(session->backend(), deviceLinesOf(*session));
  runOnThreads(context, phases, std::move(session));
  return ExitCode::Done;
}

}  // namespace

ExitCode runMeshes(const CommandLine& line, const std::vector<std::string>& arguments, const std::stop_token& stop) {
  const std::vector<MeshTask> tasks = tasksOf(line);
  if (line.outputs.opensPage) requireBrowser();
  std::optional<Interrupt::Listening> listening;  // In a batch, a signal drops the current meshes; the log has them.
  if (line.batch.isBatch()) {
    listening.emplace();
    removeUnfinishedOutputs(tasks);
  }
  BatchMonitor monitor(line, tasks);
  MeshRunner runner(line, tasks.size());
  const JobContext context{line, tasks, runner, monitor, stop};
  const std::vector<JobPhase> phases = phasesOf(line, tasks, unfinishedTasks(context));
  monitor.beginComputation();
  ExitCode code = ExitCode::Done;
  if (!phases.empty() && !stop.stop_requested()) {  // Else no device is opened.
    if (!line.batch.isBatch() && phases.back().jobCount == 1) runner.showProgressOfMeshes();
    try {
      code = line.batch.isolates ? runIsolated(context, phases, arguments) : runHere(context, phases);
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

ExitCode printDevices(const CommandLine& line) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason, line.session.requireGpu);
  writeStandardOutput(line.outputs.json ? jsonDevices(devices, reason) : textDevices(devices, reason));
  const bool hasUsable =
      std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& device) { return device.usable; });
  if (!line.session.requireGpu || hasUsable) return ExitCode::Done;
  printError("", "no GPU is usable; install the driver of the GPU, or drop --require-gpu");
  return ExitCode::Device;
}

}  // namespace asdfvk
