#include "batch/engine.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <numeric>
#include <thread>
#include <utility>

#include "batch/input_list.h"
#include "batch/lanes.h"
#include "batch/message_channel.h"
#include "batch/worker.h"
#include "core/abandoned_files.h"
#include "core/parallel.h"
#include "process/interrupt.h"

namespace asdfvk {
namespace {

constexpr int kInternalCode = 70;

/// Whether a stop is requested. Waits up to 0.5 s, because a signal may reach a worker before this process.
bool isStopping(const std::stop_token& stop) {
  constexpr int kAttempts = 50;
  for (int i = 0; i < kAttempts && !stop.stop_requested(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return stop.stop_requested();
}

class Engine {
 public:
  Engine(const std::vector<Job>& jobs, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
         const std::stop_token& stop)
      : jobs_(jobs), options_(options), client_(client), monitor_(monitor), stop_(stop) {}

  void run(JobStream& stream) {
    const uint32_t atOnce = options_.requestedAtOnce > 0 ? options_.requestedAtOnce : options_.threadCount;
    const JobPhase phase{.jobs = {}, .atOnce = atOnce, .threadCount = std::max(1U, options_.threadCount / atOnce)};
    std::map<size_t, Job> current;
    monitor_.beginComputation();
    const JobSupply supply([&](size_t) { return stream.next(); }, stream.descriptor());
    const auto jobAt = [&](size_t i) -> const Job& {
      const auto [job, isNew] = current.try_emplace(i);
      if (isNew) job->second = stream.take(i);
      return job->second;
    };
    const auto add = [&](size_t i, JobResult result) {
      current.erase(i);
      stream.add(i, std::move(result));
    };
    const std::optional<OpenFailure> failure = runInWorkerPool(phase, supply, jobAt, add);
    if (failure) report(*failure, stream.next() != JobSupply::State::Ended);
  }

  void run() {
    std::vector<size_t> pending = addFinished();
    monitor_.beginComputation();
    const std::vector<JobPhase> phases =
        planJobs(jobs_, std::move(pending), options_.requestedAtOnce, options_.threadCount);
    const bool hasLanes = sharesDevice(phases);
    for (const JobPhase& phase : phases) {
      if (stop_.stop_requested()) return;
      if (options_.isolates || (phase.atOnce > 1 && !hasLanes)) {
        runInWorkerPool(phase);
      } else {
        runHere(phase, atOnceOnGpu(phase));
      }
    }
  }

 private:
  [[nodiscard]] uint32_t atOnceOnGpu(const JobPhase& phase) const {
    return options_.requestedAtOnce > 0 ? phase.atOnce : std::min(phase.atOnce, kMaxLanesOnGpu);
  }

  /// Whether phases with several jobs at once run in this process.
  [[nodiscard]] bool sharesDevice(const std::vector<JobPhase>& phases) const {
    uint32_t count = 1;
    for (const JobPhase& phase : phases) count = std::max(count, atOnceOnGpu(phase));
    return count > 1 && !options_.isolates && client_.shareDevice && client_.shareDevice(count);
  }

  /// Adds the results of earlier runs. Returns the indices of the jobs without such a result.
  [[nodiscard]] std::vector<size_t> addFinished() {
    std::vector<size_t> pending(jobs_.size());
    std::iota(pending.begin(), pending.end(), size_t{0});
    if (!client_.findFinished) return pending;
    std::vector<char> isFinished(jobs_.size(), 0);
    forEachTask(jobs_.size(), [&](size_t i) {
      if (stop_.stop_requested()) return;
      std::optional<JobResult> result = client_.findFinished(jobs_[i]);
      if (!result) return;
      monitor_.add(i, std::move(*result));
      isFinished[i] = 1;
    });
    std::erase_if(pending, [&](size_t i) { return isFinished[i] != 0; });
    return pending;
  }

  /// Computes the phase in this process.
  void runHere(const JobPhase& phase, uint32_t laneCount) {
    const auto jobAt = [&](size_t i) { return i < phase.jobs.size() ? &jobs_[phase.jobs[i]] : nullptr; };
    const LaneClient client{.open =
                                [&] {
                                  std::unique_ptr<JobComputer> computer = client_.open();
                                  monitor_.announce(computer->describe());
                                  return computer;
                                },
                            .compute =
                                [&](JobComputer& computer, size_t i) {
                                  const Job* const next = laneCount == 1 ? jobAt(i + 1) : nullptr;
                                  monitor_.add(phase.jobs[i], computer.compute(*jobAt(i), next));
                                }};
    const LaneOptions lanes{laneCount, phase.threadCount * phase.atOnce / laneCount};
    if (const auto failure = runInLanes(phase.jobs.size(), lanes, client, stop_))
      monitor_.note(fmt::format("not all lanes have reopened the device: {}", failure->what()));
  }

  void runInWorkerPool(const JobPhase& phase) {
    size_t endedCount = 0;
    const auto jobAt = [&](size_t i) -> const Job& { return jobs_[phase.jobs[i]]; };
    const auto add = [&](size_t i, JobResult result) {
      ++endedCount;
      monitor_.add(phase.jobs[i], std::move(result));
    };
    const std::optional<OpenFailure> failure = runInWorkerPool(phase, phase.jobs.size(), jobAt, add);
    if (failure) report(*failure, endedCount < phase.jobs.size());
  }

  void report(const OpenFailure& failure, bool hasJobs) {
    if (hasJobs) throw OpenFailure(failure);
    monitor_.note(fmt::format("not all workers have started: {}", failure.what()));
  }

  /// Returns the failure of the latest worker that could not start, unless a stop was requested.
  template <typename JobAt, typename Add>
  std::optional<OpenFailure> runInWorkerPool(const JobPhase& phase, const JobSupply& supply, const JobAt& jobAt,
                                             const Add& add) {
    const uint32_t onGpu = atOnceOnGpu(phase);
    const Greeting greeting{client_.workerSettings, phase.threadCount, phase.threadCount * phase.atOnce / onGpu};
    const WorkerPoolOptions pool{.program = "/proc/self/exe",  // The running program, even if its file was replaced.
                                 .arguments = client_.workerArguments,
                                 .greeting = encode(greeting),
                                 .workerCount = phase.atOnce,
                                 .timeoutSeconds = options_.timeoutSeconds,
                                 .memoryBytes = options_.memoryBytes};
    std::optional<OpenFailure> failure;
    const WorkerPoolClient client{
        .request =
            [&](size_t i, uint32_t attempt) {
              Json request = jobAt(i);
              request["attemptCount"] = attempt;
              return encode(request);
            },
        .ready = [&](const std::string& answer) -> uint32_t {
          const Json json = decode(answer);
          if (json.contains("failure")) {
            failure.emplace(json["code"], json["name"], json["failure"]);
            return 0;
          }
          const auto description = json.get<ComputerDescription>();
          monitor_.announce(description);
          return description.isCpu ? phase.atOnce : onGpu;
        },
        .finished =
            [&](const JobOutcome& outcome) {
              auto [result, isSpent] = resultOf(jobAt(outcome.job), outcome);
              add(outcome.job, std::move(result));
              return !isSpent;
            },
        .retried = [&](const JobOutcome& outcome) { removeUnfinishedOutput(jobAt(outcome.job), outcome); }};
    const std::string reason = runOnWorkers(supply, pool, client, stop_);
    if (!reason.empty()) failure = OpenFailure(kInternalCode, "internal", "a worker process cannot start: " + reason);
    if (stop_.stop_requested()) return {};
    return failure;
  }

  /// Removes temporary files of a worker that has ended.
  static void removeUnfinishedOutput(const Job& job, const JobOutcome& outcome) {
    if (job.content) return;
    for (const std::string& output : {job.output, job.picture}) {
      if (output.empty()) continue;
      const auto folder = std::filesystem::path(output).parent_path();
      removeFilesOfProcess(folder.empty() ? "." : folder, outcome.worker);
    }
  }

  /// Returns the result of a job, and whether its worker gets no further job.
  std::pair<JobResult, bool> resultOf(const Job& job, JobOutcome outcome) {
    bool isDropped =
        outcome.end == JobEnd::Crashed && outcome.workerEnd.signal == 0 && outcome.workerEnd.exitCode == kCancelledCode;
    if (outcome.end == JobEnd::Answered) {
      const Json answer = decode(outcome.answer);
      auto result = answer.at("result").get<JobResult>();
      result.record.options = client_.recordOptions;
      isDropped = result.record.status == MeshStatus::Dropped;
      if (!isDropped || isStopping(stop_)) return {std::move(result), answer.at("isSpent").get<bool>()};
    } else {
      removeUnfinishedOutput(job, outcome);
    }
    if (isDropped) outcome.end = isStopping(stop_) ? JobEnd::Dropped : JobEnd::Terminated;
    JobResult result = client_.fail(job, outcome);
    result.record.attemptCount = outcome.attempt;
    result.record.totalSeconds = outcome.seconds;
    result.record.peakMemoryBytes = outcome.peakBytes;
    return {std::move(result), true};
  }

  const std::vector<Job>& jobs_;
  const EngineOptions& options_;
  const EngineClient& client_;
  Monitor& monitor_;
  const std::stop_token& stop_;
};

}  // namespace

std::vector<JobPhase> planJobs(const std::vector<Job>& jobs, std::vector<size_t> pending, uint32_t requested,
                               uint32_t threadCount) {
  if (pending.empty()) return {};
  const auto phaseOf = [&](std::vector<size_t> indices, uint64_t count) {
    const auto atOnce = static_cast<uint32_t>(std::clamp<uint64_t>(count, 1, indices.size()));
    return JobPhase{std::move(indices), atOnce, std::max(1U, threadCount / atOnce)};
  };
  if (requested == 1) return {phaseOf(std::move(pending), 1)};
  const auto isAlone = [&](size_t i) {
    return jobs[i].isStream || (requested == 0 && jobs[i].byteCount > kSmallMeshBytes);
  };
  std::vector<size_t> alone, together;
  for (const size_t i : pending) (isAlone(i) ? alone : together).push_back(i);
  uint64_t byteCount = kBytesPerMesh * together.size();
  for (const size_t i : together) byteCount += jobs[i].byteCount;
  const uint64_t count =
      requested > 0
          ? requested
          : std::min({uint64_t{threadCount}, together.size() / kMinMeshesPerWorker, byteCount / kMinBytesPerWorker});
  if (count < 2 || together.empty()) return {phaseOf(std::move(pending), 1)};
  std::vector<JobPhase> phases;
  if (!alone.empty()) phases.push_back(phaseOf(std::move(alone), 1));
  phases.push_back(phaseOf(std::move(together), count));
  return phases;
}

void runJobs(const std::vector<Job>& jobs, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
             const std::stop_token& stop) {
  Engine(jobs, options, client, monitor, stop).run();
}

void runStream(JobStream& stream, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
               const std::stop_token& stop) {
  const std::vector<Job> none;
  Engine(none, options, client, monitor, stop).run(stream);
}

}  // namespace asdfvk
