#include "batch/worker_pool.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <memory>
#include <optional>
#include <stdexcept>

#include "batch/process_memory.h"
#include "batch/worker_process.h"
#include "core/stopwatch.h"

namespace asdfvk {
namespace {

constexpr int kPollMilliseconds = 100;
/// A mesh may fill 2 GB of memory per second, 20 MB in this time.
constexpr int kMemoryPollMilliseconds = 10;
constexpr int kMaxFailedStarts = 3;

struct Worker {
  std::unique_ptr<WorkerProcess> process;
  bool isReady = false;
  std::optional<size_t> task;
  Stopwatch watch;
  uint64_t peakBytes = 0;
};

class WorkerPool {
 public:
  WorkerPool(size_t taskCount, const WorkerPoolOptions& options, const WorkerPoolClient& client,
             const std::stop_token& stop)
      : taskCount_(taskCount), options_(options), client_(client), stop_(stop), workers_(options.workerCount) {}

  void run() {
    while (!isEnded_) {
      if (stop_.stop_requested() && !stopWatch_) requestStop();
      for (Worker& worker : workers_) feed(worker);
      if (isIdle()) return;
      wait();
      for (Worker& worker : workers_)
        if (worker.process) watchOver(worker);
    }
  }

 private:
  [[nodiscard]] bool hasTasks() const { return next_ < taskCount_ && !stopWatch_; }
  [[nodiscard]] bool isIdle() const {
    return !hasTasks() && std::none_of(workers_.begin(), workers_.end(), [](const Worker& w) { return w.task; });
  }

  void start(Worker& worker) {
    worker.process = std::make_unique<WorkerProcess>(options_.command);
    worker.isReady = false;
    worker.watch = Stopwatch();
    worker.process->send(options_.greeting);
  }

  void feed(Worker& worker) {
    if (!hasTasks() || worker.task) return;
    if (!worker.process) return start(worker);
    if (!worker.isReady) return;
    worker.task = next_++;
    worker.watch = Stopwatch();
    worker.peakBytes = 0;
    worker.process->send(client_.request(*worker.task));  // Where the worker has ended, its socket reports that.
  }

  void wait() const {
    std::vector<pollfd> polled;
    for (const Worker& worker : workers_)
      if (worker.process) polled.push_back({worker.process->descriptor(), POLLIN, 0});
    double milliseconds = options_.memoryBytes > 0 ? kMemoryPollMilliseconds : kPollMilliseconds;
    if (std::isfinite(options_.timeoutSeconds))
      for (const Worker& worker : workers_)
        if (worker.task)
          milliseconds = std::min(milliseconds, 1000 * (options_.timeoutSeconds - worker.watch.seconds()) + 1);
    ::poll(polled.data(), polled.size(), static_cast<int>(std::max(0.0, milliseconds)));
  }

  void watchOver(Worker& worker) {
    const bool isOpen = worker.process->receive();
    while (const std::optional<std::string> line = worker.process->takeLine()) answer(worker, *line);
    if (isEnded_) return;
    if (!isOpen) return replace(worker);
    if (!worker.isReady && worker.watch.seconds() > options_.startSeconds) return abandonStart(worker);
    if (!worker.task) return;
    if (worker.watch.seconds() > options_.timeoutSeconds) return kill(worker, TaskEnd::TimedOut);
    if (options_.memoryBytes > 0) {
      worker.peakBytes = std::max(worker.peakBytes, residentBytesOf(worker.process->id()));
      if (worker.peakBytes > options_.memoryBytes) return kill(worker, TaskEnd::MemoryExceeded);
    }
    if (stopWatch_ && stopWatch_->seconds() > options_.graceSeconds) kill(worker, TaskEnd::Dropped);
  }

  void answer(Worker& worker, const std::string& line) {
    if (!worker.isReady) {
      worker.isReady = true;
      failedStarts_ = 0;
      if (!client_.ready(line)) isEnded_ = true;
      return;
    }
    if (worker.task) finish(worker, TaskEnd::Answered, line);
  }

  /// The worker closed its output.
  void replace(Worker& worker) {
    const pid_t id = worker.process->id();
    const std::string end = worker.process->waitForEnd();
    if (!worker.isReady) countFailedStart(end);
    if (worker.task) finish(worker, stopWatch_ ? TaskEnd::Dropped : TaskEnd::Crashed, end, id);
    worker.process.reset();
  }

  void abandonStart(Worker& worker) {
    worker.process.reset();
    countFailedStart(fmt::format("not ready after {:g} s", options_.startSeconds));
  }

  void countFailedStart(const std::string& reason) {
    if (++failedStarts_ == kMaxFailedStarts)
      throw std::runtime_error(fmt::format("worker processes end before they are ready: {}", reason));
  }

  void kill(Worker& worker, TaskEnd end) {
    const pid_t id = worker.process->id();
    worker.process->signal(SIGKILL);
    const std::string text = worker.process->waitForEnd();
    finish(worker, end, text, id);
    worker.process.reset();
  }

  void finish(Worker& worker, TaskEnd end, const std::string& text, pid_t id = 0) {
    const TaskOutcome outcome{
        *worker.task, end, text, worker.watch.seconds(), worker.peakBytes, id != 0 ? id : worker.process->id()};
    worker.task.reset();
    client_.finished(outcome);
  }

  void requestStop() {
    stopWatch_.emplace();
    for (const Worker& worker : workers_)
      if (worker.process && worker.task) worker.process->signal(SIGTERM);
  }

  size_t taskCount_, next_ = 0;
  const WorkerPoolOptions& options_;
  const WorkerPoolClient& client_;
  const std::stop_token& stop_;
  std::vector<Worker> workers_;
  std::optional<Stopwatch> stopWatch_;
  int failedStarts_ = 0;
  bool isEnded_ = false;
};

}  // namespace

void runOnWorkers(size_t taskCount, const WorkerPoolOptions& options, const WorkerPoolClient& client,
                  const std::stop_token& stop) {
  WorkerPool(taskCount, options, client, stop).run();
}

}  // namespace asdfvk
