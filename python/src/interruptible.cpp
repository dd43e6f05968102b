#include "interruptible.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>

#include "arrays.h"
#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "gil.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(20);

std::atomic<pid_t> firstProcess{0};

/// Progress of the work. The worker thread writes it, and the calling thread reports it.
struct Progress {
  std::atomic<double> fraction{0};
  std::atomic<const char*> stage{""};
};

/// Calls `callback` if the progress has changed. Returns false if the callback cancels the work.
class ProgressCall {
 public:
  ProgressCall(const Progress& progress, const py::object& callback) : progress_(progress), callback_(callback) {}

  bool operator()() {
    const double fraction = progress_.fraction;
    const char* stage = progress_.stage;
    if (callback_.is_none() || (fraction == lastFraction_ && stage == lastStage_)) return true;
    lastFraction_ = fraction;
    lastStage_ = stage;
    const py::object answer = callPython(callback_, py::make_tuple(fraction, stage));
    return !isFlag(answer) || PyObject_IsTrue(answer.ptr()) == 1;
  }

 private:
  const Progress& progress_;
  const py::object& callback_;
  double lastFraction_ = -1;
  const char* lastStage_ = nullptr;
};

/// Runs each task on a separate thread. A new thread is started only if no thread is idle. Threads are kept until the
/// process ends, because TBB 2021.8 can leak about 10 KB when a thread that used TBB ends.
class Workers {
 public:
  /// `task` may be destroyed after its future is ready.
  void run(std::packaged_task<void()> task) {
    {
      const std::lock_guard lock(mutex_);
      if (idle_ <= tasks_.size()) std::thread([this] { work(); }).detach();
      tasks_.push(std::move(task));
      ++unfinished_;
    }
    ready_.notify_one();
  }

  void wait() {
    std::unique_lock lock(mutex_);
    finished_.wait(lock, [this] { return unfinished_ == 0; });
  }

 private:
  [[noreturn]] void work() {
    for (std::unique_lock lock(mutex_);;) {
      ++idle_;
      ready_.wait(lock, [this] { return !tasks_.empty(); });
      --idle_;
      std::packaged_task<void()> task = std::move(tasks_.front());
      tasks_.pop();
      lock.unlock();
      task();
      lock.lock();
      --unfinished_;
      finished_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable ready_, finished_;
  std::queue<std::packaged_task<void()>> tasks_;
  size_t idle_ = 0;
  size_t unfinished_ = 0;  ///< Tasks that wait for a thread or run.
};

Workers& workers() {
  // The object is not destroyed at exit, because threads still wait for tasks.
  static auto* workers = new Workers;
  return *workers;
}

/// At the end of the process, a stop of this source is requested.
std::stop_source& endOfProcess() {
  static auto* source = new std::stop_source;
  return *source;
}

}  // namespace

void runInterruptibly(const std::function<void(const RunControl&)>& work, const py::object& progress) {
  Progress state;
  ProgressCall call(state, progress);
  std::stop_source source;
  const std::stop_callback stopAtEnd(endOfProcess().get_token(), [&] { source.request_stop(); });
  const RunControl control{source.get_token(), [&](double fraction) { state.fraction = fraction; },
                           [&](Stage stage) { state.stage = nameOf(stage); }};
  std::packaged_task<void()> task([&] { work(control); });
  std::future<void> done = task.get_future();
  std::exception_ptr raised;
  workers().run(std::move(task));
  const auto isDone = [&] {
    const GilRelease released;
    return done.wait_for(kPollInterval) == std::future_status::ready;
  };
  while (!isDone()) {
    if (source.stop_requested()) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!call()) source.request_stop();
    } catch (...) {
      raised = std::current_exception();
      source.request_stop();
    }
  }
  if (raised) std::rethrow_exception(raised);
  done.get();
  state.fraction = 1;
  call();
}

void stopAtExit() {
  if (isForkedProcess()) return;
  endOfProcess().request_stop();
  workers().wait();
}

bool isForkedProcess() {
  const pid_t first = firstProcess;
  return first != 0 && first != getpid();
}

void requireSameProcess() {
  pid_t unset = 0;
  firstProcess.compare_exchange_strong(unset, getpid());
  if (isForkedProcess())
    throw Error(ErrorCode::ForkedProcess,
                "this process was forked after the first use of asdf_vk and has no threads or devices of its parent; "
                "start processes with the method 'spawn' or 'forkserver', or first use asdf_vk in the child");
}

}  // namespace asdfvk::python
