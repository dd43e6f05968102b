#include "cli/job_threads.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace asdfvk {
namespace {

/// The next mesh is read ahead only up to this size, since both are in memory.
constexpr uint64_t kMaxBytesReadAhead = uint64_t{256} << 20;

/// One phase of the plan.
class JobThreads {
 public:
  JobThreads(const CommandLine& line, MeshRunner& runner, BatchMonitor& monitor, const std::vector<MeshTask>& tasks,
             const JobPhase& phase, const std::stop_token& stop)
      : line_(line), runner_(runner), monitor_(monitor), tasks_(tasks), phase_(phase), stop_(stop) {}

  void run(std::unique_ptr<Session> session) {
    uint32_t jobCount = phase_.jobCount;
    if (line_.batch.jobCount == 0 && !session->runsOnCpu()) jobCount = std::min(jobCount, kMaxJobsOnGpu);
    if (jobCount == 1) {
      runAlone(*session);
      return;
    }
    std::vector<std::jthread> threads;
    for (uint32_t job = 1; job < jobCount; ++job)
      threads.emplace_back([this] { guard([this] { runJob(openSession(line_, phase_.threadCount)); }); });
    guard([&] { runJob(std::move(session)); });
    threads.clear();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[nodiscard]] bool isEnding() const { return isEnding_ || stop_.stop_requested(); }

  /// One mesh after another, with reading ahead.
  void runAlone(Session& session) {
    std::future<LoadedMesh> next;
    for (size_t i = 0; i < phase_.tasks.size() && !isEnding(); ++i) {
      const size_t task = phase_.tasks[i];
      std::optional<LoadedMesh> loaded;
      if (next.valid()) loaded = next.get();
      if (i + 1 < phase_.tasks.size()) next = readAhead(tasks_[phase_.tasks[i + 1]]);
      monitor_.add(task, runner_.run(session, tasks_[task], std::move(loaded), true, stop_));
    }
  }

  [[nodiscard]] std::future<LoadedMesh> readAhead(const MeshTask& task) const {
    if (task.input == "-" || task.byteCount == 0 || task.byteCount > kMaxBytesReadAhead) return {};
    return std::async(std::launch::async, [this, &task] { return loadMesh(task.input, line_.batch.isBatch()); });
  }

  void runJob(std::unique_ptr<Session> session) {
    tbb::task_arena arena(static_cast<int>(phase_.threadCount));
    for (size_t i = nextTask_++; i < phase_.tasks.size() && !isEnding(); i = nextTask_++) {
      const size_t task = phase_.tasks[i];
      MeshRun run;
      arena.execute([&] { run = runner_.run(*session, tasks_[task], std::nullopt, false, stop_); });
      monitor_.add(task, std::move(run));
    }
  }

  template <typename Work>
  void guard(const Work& work) {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      isEnding_ = true;
    }
  }

  const CommandLine& line_;
  MeshRunner& runner_;
  BatchMonitor& monitor_;
  const std::vector<MeshTask>& tasks_;
  const JobPhase& phase_;
  const std::stop_token& stop_;
  std::atomic<size_t> nextTask_{0};
  std::atomic<bool> isEnding_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

std::unique_ptr<Session> openSession(const CommandLine& line, uint32_t threadCount) {
  const ThreadLimit limit(threadCount);
  return std::make_unique<Session>(line.session);
}

void runOnThreads(const CommandLine& line, MeshRunner& runner, BatchMonitor& monitor,
                  const std::vector<MeshTask>& tasks, const std::vector<JobPhase>& phases,
                  std::unique_ptr<Session> session, const std::stop_token& stop) {
  for (const JobPhase& phase : phases) {
    if (stop.stop_requested()) return;
    if (!session) session = openSession(line, phase.threadCount);
    JobThreads(line, runner, monitor, tasks, phase, stop).run(std::move(session));
    session.reset();
  }
}

}  // namespace asdfvk
