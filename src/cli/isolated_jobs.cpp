#include "cli/isolated_jobs.h"

#include <fmt/core.h>

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

/// The failure of a mesh whose worker was killed or crashed.
Failure failureOf(const TaskOutcome& outcome, const BatchOptions& batch) {
  switch (outcome.end) {
    case TaskEnd::TimedOut:
      return timeLimitFailure(batch.timeoutSeconds);
    case TaskEnd::MemoryExceeded:
      return {ExitCode::Limit, fmt::format("took {} MiB of memory, more than --memory-limit", outcome.peakBytes >> 20),
              "memoryLimit"};
    case TaskEnd::Dropped:
      return cancelledFailure();
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

/// Whether a stop is requested. Waits up to 0.5 s for it, because a signal to the process group may reach a worker
/// first.
bool isStopping(const std::stop_token& stop) {
  constexpr int kAttempts = 50;
  for (int i = 0; i < kAttempts && !stop.stop_requested(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return stop.stop_requested();
}

/// One phase of the plan.
class IsolatedPhase {
 public:
  IsolatedPhase(const JobContext& context, const JobPhase& phase) : context_(context), phase_(phase) {}

  /// Returns the code of the failure if the workers cannot start, else Done.
  ExitCode run(const std::vector<std::string>& arguments) {
    Json greeting{{"arguments", Json::array()}, {"jobs", phase_.jobCount}, {"threads", phase_.threadCount}};
    for (const std::string& argument : arguments) greeting["arguments"].push_back(textOfBytes(argument));
    const WorkerPoolOptions options{.program = "/proc/self/exe",  // The running program, also if its file was replaced.
                                    .arguments = {"asdf-vk", kWorkerArgument},
                                    .greeting = lineOf(greeting),
                                    .workerCount = phase_.jobCount,
                                    .timeoutSeconds = context_.line.batch.timeoutSeconds,
                                    .memoryBytes = context_.line.batch.memoryBytes};
    const WorkerPoolClient client{
        .request = [this](size_t index) { return lineOf(requestOf(context_.tasks[phase_.tasks[index]])); },
        .ready = [this](const std::string& answer) { return takeReady(Json::parse(answer)); },
        .finished = [this](const TaskOutcome& outcome) { return takeOutcome(outcome); }};
    const std::string reason = runOnWorkers(phase_.tasks.size(), options, client, context_.stop);
    if (!reason.empty()) failure_ = {ExitCode::Internal, "a worker process cannot start: " + reason};
    if (!failure_) return ExitCode::Done;
    const auto& [code, message] = *failure_;
    if (context_.stop.stop_requested()) return ExitCode::Done;
    if (finishedCount_ == phase_.tasks.size()) {
      context_.monitor.note(warningLine("", "fewer workers than --jobs: " + message));
      return ExitCode::Done;
    }
    printError("", message);
    return code;
  }

 private:
  /// Returns the maximum number of workers.
  uint32_t takeReady(const Json& answer) {
    if (answer.contains("failure")) {
      failure_ = {static_cast<ExitCode>(answer.at("code").get<int>()),
                  bytesOfText(answer.at("failure").get<std::string>())};
      return 0;
    }
    context_.monitor.announce(answer.at("backend").get<std::string>(),
                              bytesOfText(answer.at("devices").get<std::string>()));
    return jobsOn(phase_, answer.at("isCpu").get<bool>(), context_.line.batch.jobCount);
  }

  /// Returns whether the worker gets further meshes.
  bool takeOutcome(const TaskOutcome& outcome) {
    ++finishedCount_;
    const size_t index = phase_.tasks[outcome.task];
    const MeshTask& task = context_.tasks[index];
    if (outcome.end != TaskEnd::Answered) {
      const auto folder = std::filesystem::path(task.output).parent_path();
      removeFilesOfProcess(folder.empty() ? "." : folder, outcome.worker);
      // A signal between two meshes ends a worker at once.
      const bool wasSignalled = outcome.end == TaskEnd::Crashed && outcome.workerEnd.signal == 0 &&
                                outcome.workerEnd.exitCode == static_cast<int>(ExitCode::Cancelled);
      addFailure(index, wasSignalled ? failureBySignal() : failureOf(outcome, context_.line.batch), outcome);
      return false;
    }
    const Json answer = Json::parse(outcome.answer);
    MeshRun run = runOf(answer);
    if (run.code == ExitCode::Cancelled && !isStopping(context_.stop)) {
      addFailure(index, failureBySignal(), outcome);
      return false;
    }
    if (run.record.output) run.record.output = task.output;  // JSON has replacements for bytes that are not UTF-8.
    context_.monitor.add(index, std::move(run));
    return !answer.at("ends").get<bool>();
  }

  [[nodiscard]] Failure failureBySignal() const {
    if (isStopping(context_.stop)) return cancelledFailure();
    return {ExitCode::Internal, "another process ended the worker process by a signal", "crashed"};
  }

  void addFailure(size_t index, const Failure& failure, const TaskOutcome& outcome) {
    MeshRun run = context_.runner.failedRun(context_.tasks[index], failure);
    run.record.totalSeconds = outcome.seconds;
    run.record.peakMemoryBytes = outcome.peakBytes;
    context_.monitor.add(index, std::move(run));
  }

  const JobContext& context_;
  const JobPhase& phase_;
  std::optional<std::pair<ExitCode, std::string>> failure_;  ///< Of the last worker that could not start.
  size_t finishedCount_ = 0;
};

}  // namespace

ExitCode runIsolated(const JobContext& context, const std::vector<JobPhase>& phases,
                     const std::vector<std::string>& arguments) {
  for (const JobPhase& phase : phases) {
    if (context.stop.stop_requested()) break;
    const ExitCode code = IsolatedPhase(context, phase).run(arguments);
    if (code != ExitCode::Done) return code;
  }
  return ExitCode::Done;
}

}  // namespace asdfvk
