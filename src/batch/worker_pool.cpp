#include "batch/worker_pool.h"

#include <fmt/core.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <deque>
#include <memory>
#include <optional>
#include <system_error>

#include "batch/process_memory.h"
#include "core/stopwatch.h"

namespace asdfvk {
namespace {

constexpr int kPollMilliseconds = 100;
/// Between two polls, a mesh may fill 20 MB of memory (2 GB per second).
constexpr int kMemoryPollMilliseconds = 10;
constexpr int kMaxFailedStarts = 3;
/// A worker is replaced after a job if it still uses more than this share of the memory for jobs. The memory for jobs
/// is the limit minus the memory of a ready worker. Without this rule, the next job could fail because of earlier jobs.
constexpr double kMaxKeptShare = 0.5;

struct Worker {
  std::unique_ptr<WorkerProcess> process;
  bool isReady = false, hasServed = false;
  bool isGivenUp = false;  ///< No further process is started for this worker.
  int failedStarts = 0;    ///< Consecutive failed starts.
  std::optional<size_t> job;
  uint32_t attempt = 1;     ///< Attempt of the job.
  Stopwatch watch;          ///< Measures the time since the greeting or the job was sent.
  uint64_t readyBytes = 0;  ///< Memory when the worker became ready.
  uint64_t peakBytes = 0;
};

/// The system also ends processes by SIGKILL if memory runs out.
bool isKilledForMemory(const JobOutcome& outcome) {
  return outcome.end == JobEnd::MemoryExceeded ||
         (outcome.end == JobEnd::Crashed && outcome.workerEnd.signal == SIGKILL);
}

class WorkerPool {
 public:
  WorkerPool(const JobSupply& jobs, const WorkerPoolOptions& options, const WorkerPoolClient& client,
             const std::stop_token& stop)
      : jobs_(jobs), options_(options), client_(client), stop_(stop), workers_(options.workerCount) {}

  std::string run() {
    for (;;) {
      if (stop_.stop_requested() && !stopWatch_) requestStop();
      if (isAlone_ && retries_.empty() && !isAtWork()) endAlone();
      if (!isAlone_ && hasRetriesOnly()) beginAlone();
      for (Worker& worker : workers_) feed(worker);
      if (isIdle()) {
        abandonRetries();
        return failure_;
      }
      wait();
      for (Worker& worker : workers_)
        if (worker.process) watchOver(worker);
    }
  }

 private:
  [[nodiscard]] bool isAt(JobSupply::State state) const { return jobs_.next(next_) == state; }
  [[nodiscard]] bool hasJobs() const {
    return !stopWatch_ && (isAlone_ ? !retries_.empty() : isAt(JobSupply::State::Ready));
  }
  [[nodiscard]] bool hasWorkers() const {
    return std::any_of(workers_.begin(), workers_.end(), [](const Worker& w) { return !w.isGivenUp; });
  }
  [[nodiscard]] bool isAtWork() const {
    return std::any_of(workers_.begin(), workers_.end(), [](const Worker& w) { return w.job; });
  }
  [[nodiscard]] bool isIdle() const {
    return !isAtWork() && (stopWatch_ || !hasWorkers() || (retries_.empty() && isAt(JobSupply::State::Ended)));
  }
  /// Also while jobs of a stream may follow: they may wait for the results of these retries.
  [[nodiscard]] bool hasRetriesOnly() const {
    return !stopWatch_ && !retries_.empty() && hasWorkers() && !isAtWork() && !isAt(JobSupply::State::Ready);
  }

  /// Ends all workers, which may keep memory of earlier jobs, and continues with one.
  void beginAlone() {
    isAlone_ = true;
    workers_.clear();
    workers_.resize(1);
  }

  void endAlone() {
    isAlone_ = false;
    workers_.resize(options_.workerCount);
  }

  /// Ends the jobs whose second attempt did not begin.
  void abandonRetries() {
    for (JobOutcome& outcome : retries_) {
      if (stopWatch_) outcome.end = JobEnd::Dropped;
      client_.finished(outcome);
    }
    retries_.clear();
  }

  /// Only one process may run until a worker is ready. Then client_.ready() determines the number.
  [[nodiscard]] bool mayStart(const Worker& worker) const {
    if (worker.isGivenUp) return false;
    const auto startedCount = static_cast<uint32_t>(
        std::count_if(workers_.begin(), workers_.end(), [](const Worker& w) { return w.process != nullptr; }));
    return startedCount < allowedCount_;
  }

  void start(Worker& worker) {
    try {
      worker.process = std::make_unique<WorkerProcess>(options_.program, options_.arguments);
    } catch (const std::system_error& error) {
      countFailedStart(worker, error.what());
      if (worker.isGivenUp && !hasStarted_) throw;
      return;
    }
    worker.isReady = worker.hasServed = false;
    worker.watch = Stopwatch();
    worker.process->messages().send(options_.greeting);
  }

  void feed(Worker& worker) {
    if (!hasJobs() || worker.job) return;
    if (worker.process && worker.hasServed && (isAlone_ || hasGrown(worker))) worker.process.reset();
    if (!worker.process && mayStart(worker)) start(worker);
    if (!worker.process || !worker.isReady) return;
    worker.attempt = isAlone_ ? 2 : 1;
    worker.job = isAlone_ ? retries_.front().job : next_++;
    if (isAlone_) retries_.pop_front();
    worker.watch = Stopwatch();
    worker.peakBytes = 0;
    // If the worker has ended, watchOver() will detect it.
    worker.process->messages().send(client_.request(*worker.job, worker.attempt));
  }

  [[nodiscard]] bool hasGrown(const Worker& worker) const {
    // There is no limit, or a ready worker without a job already exceeds the limit.
    if (options_.memoryBytes <= worker.readyBytes) return false;
    const auto ready = static_cast<double>(worker.readyBytes);
    const double kept = static_cast<double>(residentBytesOf(worker.process->id())) - ready;
    return kept > kMaxKeptShare * (static_cast<double>(options_.memoryBytes) - ready);
  }

  void wait() const {
    std::vector<pollfd> polled;
    for (const Worker& worker : workers_)
      if (worker.process) polled.push_back({worker.process->descriptor(), POLLIN, 0});
    if (jobs_.descriptor >= 0 && !stopWatch_ && !isAlone_) polled.push_back({jobs_.descriptor, POLLIN, 0});
    double milliseconds = options_.memoryBytes > 0 ? kMemoryPollMilliseconds : kPollMilliseconds;
    if (std::isfinite(options_.timeoutSeconds))
      for (const Worker& worker : workers_)
        if (worker.job)
          milliseconds = std::min(milliseconds, 1000 * (options_.timeoutSeconds - worker.watch.seconds()) + 1);
    ::poll(polled.data(), polled.size(), static_cast<int>(std::max(0.0, milliseconds)));
  }

  void watchOver(Worker& worker) {
    const bool isOpen = worker.process->messages().receive();
    while (const std::optional<std::string> message = worker.process->messages().take()) {
      answer(worker, *message);
      if (!worker.process) return;
    }
    if (!isOpen) return replace(worker);
    if (!worker.isReady && worker.watch.seconds() > options_.startSeconds) {
      worker.process.reset();
      return countFailedStart(worker, fmt::format("not ready after {:g} s", options_.startSeconds));
    }
    if (!worker.job) return;
    if (worker.watch.seconds() > options_.timeoutSeconds) return kill(worker, JobEnd::TimedOut);
    if (options_.memoryBytes > 0) {
      worker.peakBytes = std::max(worker.peakBytes, residentBytesOf(worker.process->id()));
      if (worker.peakBytes > options_.memoryBytes) return kill(worker, JobEnd::MemoryExceeded);
    }
    if (stopWatch_ && stopWatch_->seconds() > options_.graceSeconds) kill(worker, JobEnd::Dropped);
  }

  void answer(Worker& worker, const std::string& message) {
    if (!worker.isReady) {
      const uint32_t count = client_.ready(message);
      if (count == 0) {
        worker.process.reset();
        return giveUp(worker);
      }
      worker.isReady = true;
      worker.readyBytes = residentBytesOf(worker.process->id());
      worker.failedStarts = 0;
      allowedCount_ = count;
      hasStarted_ = true;
      return;
    }
    if (!worker.job) return;
    const pid_t id = worker.process->id();
    worker.hasServed = true;
    if (!finish(worker, {.end = JobEnd::Answered, .answer = message, .worker = id})) worker.process.reset();
  }

  /// Handles a worker that closed its socket: ends the process and its job.
  void replace(Worker& worker) {
    const pid_t id = worker.process->id();
    const ProcessEnd end = worker.process->waitForEnd();
    worker.process.reset();
    if (!worker.isReady) countFailedStart(worker, textOf(end));
    if (worker.job)
      finish(worker, {.end = stopWatch_ ? JobEnd::Dropped : JobEnd::Crashed, .workerEnd = end, .worker = id});
  }

  void countFailedStart(Worker& worker, const std::string& reason) {
    if (++worker.failedStarts < kMaxFailedStarts) return;
    failure_ = reason;
    giveUp(worker);
  }

  /// Gives up the worker. If no worker was ready before, gives up all workers, because they would fail in the same way.
  void giveUp(Worker& worker) {
    worker.isGivenUp = true;
    if (!hasStarted_)
      for (Worker& other : workers_) other.isGivenUp = true;
  }

  void kill(Worker& worker, JobEnd end) {
    const pid_t id = worker.process->id();
    worker.process->signal(SIGKILL);
    const ProcessEnd processEnd = worker.process->waitForEnd();
    worker.process.reset();
    finish(worker, {.end = end, .workerEnd = processEnd, .worker = id});
  }

  bool finish(Worker& worker, JobOutcome outcome) {
    outcome.job = *worker.job;
    outcome.seconds = worker.watch.seconds();
    outcome.peakBytes = worker.peakBytes;
    outcome.attempt = worker.attempt;
    worker.job.reset();
    if (outcome.attempt == 1 && isKilledForMemory(outcome)) {
      if (client_.retried) client_.retried(outcome);
      retries_.push_back(outcome);
      return false;
    }
    return client_.finished(outcome);
  }

  void requestStop() {
    stopWatch_.emplace();
    for (const Worker& worker : workers_)
      if (worker.process && worker.job) worker.process->signal(SIGTERM);
  }

  const JobSupply& jobs_;
  size_t next_ = 0;
  const WorkerPoolOptions& options_;
  const WorkerPoolClient& client_;
  const std::stop_token& stop_;
  std::vector<Worker> workers_;
  std::deque<JobOutcome> retries_;  ///< First outcomes of jobs that are tried again.
  bool isAlone_ = false;            ///< Whether only second attempts begin.
  uint32_t allowedCount_ = 1;       ///< Number of processes that may run at the same time.
  bool hasStarted_ = false;         ///< Whether any worker was ready.
  std::optional<Stopwatch> stopWatch_;
  std::string failure_;  ///< Reason why the last worker could not start.
};

}  // namespace

std::string runOnWorkers(const JobSupply& jobs, const WorkerPoolOptions& options, const WorkerPoolClient& client,
                         const std::stop_token& stop) {
  return WorkerPool(jobs, options, client, stop).run();
}

}  // namespace asdfvk
