#include "cli/isolated_jobs.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "batch/worker_pool.h"
#include "cli/batch_worker.h"
#include "cli/terminal.h"
#include "cli/worker_messages.h"
#include "core/atomic_file.h"

namespace asdfvk {
namespace {

/// How a mesh fails whose worker was killed or crashed.
Failure failureOf(const TaskOutcome& outcome, const BatchOptions& batch) {
  switch (outcome.end) {
    case TaskEnd::TimedOut:
      return {ExitCode::Limit, fmt::format("took longer than --timeout {:g}", batch.timeoutSeconds), "timeLimit"};
    case TaskEnd::MemoryExceeded:
      return {ExitCode::Limit, fmt::format("took {} MiB of memory, more than --memory-limit", outcome.peakBytes >> 20),
              "memoryLimit"};
    case TaskEnd::Dropped:
      return {ExitCode::Cancelled, "cancelled", "cancelled"};
    default:
      break;
  }
  if (outcome.workerEnd.signal == SIGKILL)
    return {ExitCode::Internal,
            "the worker process was killed (signal 9), probably because memory ran out; give --memory-limit, or fewer "
            "--jobs",
            "crashed"};
  return {ExitCode::Internal,
          fmt::format("internal error: the worker process {}; please report it", textOf(outcome.workerEnd)), "crashed"};
}

/// Whether the run is being stopped. A signal to the process group reaches a worker and this process, in any order.
bool isStopping(const std::stop_token& stop) {
  constexpr int kAttempts = 50;
  for (int i = 0; i < kAttempts && !stop.stop_requested(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return stop.stop_requested();
}

/// One phase of the plan.
class IsolatedPhase {
 public:
  IsolatedPhase(const CommandLine& line, MeshRunner& runner, BatchMonitor& monitor, const std::vector<MeshTask>& tasks,
                const JobPhase& phase, const std::stop_token& stop)
      : line_(line), runner_(runner), monitor_(monitor), tasks_(tasks), phase_(phase), stop_(stop) {}

  /// Returns the failure of the workers to start, or Done.
  ExitCode run(const std::vector<std::string>& arguments) {
    Json greeting{{"arguments", Json::array()}, {"jobs", phase_.jobCount}, {"threads", phase_.threadCount}};
    for (const std::string& argument : arguments) greeting["arguments"].push_back(textOfBytes(argument));
    const WorkerPoolOptions options{.program = "/proc/self/exe",  // Also where the file has been replaced meanwhile.
                                    .arguments = {"asdf-vk", kWorkerArgument},
                                    .greeting = lineOf(greeting),
                                    .workerCount = phase_.jobCount,
                                    .timeoutSeconds = line_.batch.timeoutSeconds,
                                    .memoryBytes = line_.batch.memoryBytes};
    const WorkerPoolClient client{
        .request = [this](size_t index) { return lineOf(requestOf(tasks_[phase_.tasks[index]])); },
        .ready = [this](const std::string& answer) { return takeReady(Json::parse(answer)); },
        .finished = [this](const TaskOutcome& outcome) { return takeOutcome(outcome); }};
    const std::string reason = runOnWorkers(phase_.tasks.size(), options, client, stop_);
    if (!reason.empty()) failure_ = {ExitCode::Internal, "a worker process cannot start: " + reason};
    if (!failure_) return ExitCode::Done;
    const auto& [code, message] = *failure_;
    if (stop_.stop_requested()) return ExitCode::Done;
    if (finishedCount_ == phase_.tasks.size()) {
      monitor_.note(warningLine("", "fewer workers than --jobs: " + message));
      return ExitCode::Done;
    }
    printError("", message);
    return code;
  }

 private:
  /// How many workers may exist.
  uint32_t takeReady(const Json& answer) {
    if (answer.contains("failure")) {
      failure_ = {static_cast<ExitCode>(answer.at("code").get<int>()),
                  bytesOfText(answer.at("failure").get<std::string>())};
      return 0;
    }
    monitor_.announce(answer.at("backend").get<std::string>(), bytesOfText(answer.at("devices").get<std::string>()));
    return jobsOn(phase_, answer.at("isCpu").get<bool>(), line_.batch.jobCount);
  }

  /// Whether the worker takes further meshes.
  bool takeOutcome(const TaskOutcome& outcome) {
    ++finishedCount_;
    const size_t index = phase_.tasks[outcome.task];
    const MeshTask& task = tasks_[index];
    if (outcome.end != TaskEnd::Answered) {
      const auto folder = std::filesystem::path(task.output).parent_path();
      removeFilesOfProcess(folder.empty() ? "." : folder, outcome.worker);
      // A signal between two meshes ends a worker at once.
      const bool wasSignalled = outcome.end == TaskEnd::Crashed && outcome.workerEnd.signal == 0 &&
                                outcome.workerEnd.exitCode == static_cast<int>(ExitCode::Cancelled);
      addFailure(index, wasSignalled ? failureBySignal() : failureOf(outcome, line_.batch), outcome);
      return false;
    }
    const Json answer = Json::parse(outcome.answer);
    MeshRun run = runOf(answer);
    if (run.code == ExitCode::Cancelled && !isStopping(stop_)) {
      addFailure(index, failureBySignal(), outcome);
      return false;
    }
    run.record.input = task.input;  // Not all names survive JSON.
    if (run.record.output) run.record.output = task.output;
    monitor_.add(index, std::move(run));
    return !answer.at("ends").get<bool>();
  }

  [[nodiscard]] Failure failureBySignal() const {
    if (isStopping(stop_)) return {ExitCode::Cancelled, "cancelled", "cancelled"};
    return {ExitCode::Internal, "another process ended the worker process by a signal", "crashed"};
  }

  void addFailure(size_t index, const Failure& failure, const TaskOutcome& outcome) {
    MeshRun run = runner_.failedRun(tasks_[index], failure);
    run.record.totalSeconds = outcome.seconds;
    run.record.peakMemoryBytes = outcome.peakBytes;
    monitor_.add(index, std::move(run));
  }

  const CommandLine& line_;
  MeshRunner& runner_;
  BatchMonitor& monitor_;
  const std::vector<MeshTask>& tasks_;
  const JobPhase& phase_;
  const std::stop_token& stop_;
  std::optional<std::pair<ExitCode, std::string>> failure_;  ///< Of the last worker that could not start.
  size_t finishedCount_ = 0;
};

}  // namespace

ExitCode runIsolated(const CommandLine& line, const std::vector<std::string>& arguments, MeshRunner& runner,
                     BatchMonitor& monitor, const std::vector<MeshTask>& tasks, const std::vector<JobPhase>& phases,
                     const std::stop_token& stop) {
  for (const JobPhase& phase : phases) {
    if (stop.stop_requested()) break;
    const ExitCode code = IsolatedPhase(line, runner, monitor, tasks, phase, stop).run(arguments);
    if (code != ExitCode::Done) return code;
  }
  return ExitCode::Done;
}

}  // namespace asdfvk
