#include "cli/job_threads.h"

#include <fmt/core.h>

#include <atomic>
#include <exception>
#include <future>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <utility>

#include "cli/terminal.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Larger meshes are not read ahead, because two meshes are in memory then.
constexpr uint64_t kMaxBytesReadAhead = uint64_t{256} << 20;

/// One phase of the plan.
class JobThreads {
 public:
  JobThreads(const JobContext& context, const JobPhase& phase) : context_(context), phase_(phase) {}

  void run(std::unique_ptr<Session> session) {
    const bool isCpu = session->runsOnCpu();
    threadCount_ = threadsOn(phase_, isCpu, context_.line.batch.jobCount);
    std::vector<std::unique_ptr<Session>> sessions = openFurther(std::move(session), isCpu);
    liveJobCount_ = static_cast<uint32_t>(sessions.size());
    if (sessions.size() == 1) return runAlone(std::move(sessions.front()));
    std::vector<std::jthread> threads;
    for (std::unique_ptr<Session>& own : sessions)
      threads.emplace_back([this, &own] { guard([&] { runJob(std::move(own)); }); });
    threads.clear();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[nodiscard]] bool isEnding() const { return isEnding_ || context_.stop.stop_requested(); }

  /// A session per job. The sessions are opened one after another and before the first mesh, because drivers read
  /// environment variables, which ThreadLimit sets while a session is opened.
  [[nodiscard]] std::vector<std::unique_ptr<Session>> openFurther(std::unique_ptr<Session> first, bool isCpu) const {
    std::vector<std::unique_ptr<Session>> sessions;
    sessions.push_back(std::move(first));
    const uint32_t jobCount = jobsOn(phase_, isCpu, context_.line.batch.jobCount);
    try {
      while (sessions.size() < jobCount && !context_.stop.stop_requested())
        sessions.push_back(openSession(context_.line, threadCount_));
    } catch (const Error& error) {
      context_.monitor.note(
          warningLine("", fmt::format("{} of {} jobs run: {}", sessions.size(), jobCount, error.what())));
    }
    return sessions;
  }

  /// One mesh after another, with reading ahead.
  void runAlone(std::unique_ptr<Session> session) {
    std::future<LoadedMesh> next;
    for (size_t i = 0; i < phase_.tasks.size() && !isEnding(); ++i) {
      const size_t task = phase_.tasks[i];
      std::optional<LoadedMesh> loaded;
      if (next.valid()) loaded = next.get();
      if (i + 1 < phase_.tasks.size()) next = readAhead(context_.tasks[phase_.tasks[i + 1]]);
      runMesh(session, task, std::move(loaded), true, i + 1 == phase_.tasks.size());
    }
  }

  [[nodiscard]] std::future<LoadedMesh> readAhead(const MeshTask& task) const {
    if (task.input == "-" || task.byteCount == 0 || task.byteCount > kMaxBytesReadAhead) return {};
    return std::async(std::launch::async,
                      [this, &task] { return loadMesh(task.input, context_.line.batch.isBatch(), context_.stop); });
  }

  void runJob(std::unique_ptr<Session> session) {
    callWithThreads(threadCount_, [&] {
      for (size_t i = 0; session && !isEnding() && (i = nextTask_++) < phase_.tasks.size();)
        runMesh(session, phase_.tasks[i], std::nullopt, false, nextTask_ >= phase_.tasks.size());
    });
  }

  /// After a failure of the device, opens the session again, unless this was the last mesh. If that fails, the session
  /// is null, and the other jobs compute the remaining meshes. isAlone: no other mesh is computed at the same time.
  void runMesh(std::unique_ptr<Session>& session, size_t task, std::optional<LoadedMesh> loaded, bool isAlone,
               bool isLast) {
    const std::string backend = session->backend();
    MeshRun run = [&] {
      const std::shared_lock lock(computing_);
      return context_.runner.run(*session, context_.tasks[task], std::move(loaded), isAlone, context_.stop);
    }();
    const bool hasFailed = run.code == ExitCode::Device || session->backend() != backend;
    context_.monitor.add(task, std::move(run));
    if (!hasFailed || isLast || isEnding()) return;
    session.reset();
    const std::unique_lock lock(computing_);  // As in openFurther().
    try {
      session = openSession(context_.line, threadCount_);
    } catch (const Error& error) {
      if (--liveJobCount_ == 0) throw;
      context_.monitor.note(warningLine("", fmt::format("{} jobs run: {}", liveJobCount_.load(), error.what())));
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

  const JobContext& context_;
  const JobPhase& phase_;
  uint32_t threadCount_ = 1;
  std::atomic<size_t> nextTask_{0};
  std::atomic<bool> isEnding_{false};
  std::atomic<uint32_t> liveJobCount_{1};
  std::shared_mutex computing_;  ///< Shared while a mesh is computed, exclusive while a session is opened.
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

std::unique_ptr<Session> openSession(const CommandLine& line, uint32_t threadCount) {
  const ThreadLimit limit(threadCount);
  return std::make_unique<Session>(line.session);
}

void runOnThreads(const JobContext& context, const std::vector<JobPhase>& phases, std::unique_ptr<Session> session) {
  for (const JobPhase& phase : phases) {
    if (context.stop.stop_requested()) return;
    if (!session) session = openSession(context.line, phase.threadCount);
    JobThreads(context, phase).run(std::move(session));
    session.reset();
  }
}

}  // namespace asdfvk
